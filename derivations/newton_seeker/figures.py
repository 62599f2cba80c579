"""The figures of Section VI, drawn from runs of the pipeline with h = 1 when the report asks for them."""

from __future__ import annotations

from collections.abc import Iterator

from ptproof.report.content import Figure

CAPTIONS = {
    "hessian": "the Riccati filter's state d, with the published instants (dots), and 1/H (dashed)",
    "field": "field at the vehicle, Newton and gradient seeker; dashed, the peak",
    "gap": "largest gap of the Newton seeker to its average over a ladder of ω, for p = 3/4",
}


def figures() -> Iterator[Figure]:
    """Each of them, one after the other."""
    import sympy as sp

    from ptproof.simulation.drawing import BLUE, GREEN, RED, new_figure, svg

    from .experiments import observations as seen
    from .notation import F_star, H
    from .section6_simulation import NUMBERS, START

    runs = {name: seen.run(name, 1) for name in ("newton", "gradient")}
    drawn = {name: new_figure() for name in ("hessian", "field")}
    axes = drawn["hessian"][1]
    axes.plot(runs["newton"].t, runs["newton"]["d"], color=BLUE)
    axes.plot(seen.PUBLISHED[:, 0], seen.PUBLISHED[:, 3], "o", color=RED, ms=3)
    axes.axhline(seen.INVERSE, color=RED, lw=0.8, ls="--")
    axes.set(xlabel="t", ylabel="d")
    axes = drawn["field"][1]
    for (name, run), colour in zip(runs.items(), (BLUE, GREEN), strict=True):
        field = float(START[F_star]) - float(NUMBERS[H]) / 2 * seen.distance(run) ** 2
        axes.plot(run.t, field, color=colour, label=f"{name} seeker")
    axes.axhline(float(START[F_star]), color=RED, lw=0.8, ls="--")
    axes.set(xlabel="t", ylabel="field value")
    axes.legend()
    made = {name: figure for name, (figure, _) in drawn.items()}
    made["gap"] = seen.order("newton", sp.Rational(3, 4)).plot().figure
    for name, figure in made.items():
        yield Figure(f"newton-{name}", f"Section VI: {CAPTIONS[name]}. Repeat: `ptproof report`.", svg(figure))
