"""The paper's block diagram (fig:unicycle_pt_controller) in numbers, against the equations, and drawn.

Its washout filter s/(μs + 1) is drawn time-invariant in t, whereas eq:z scales the filter's rate by K(t). Built from
its parts, the figure as drawn is therefore not eq:closed_loop_system_t: its filter gives dy/dt, so that
θ̇ = K(ω − k dy/dt), where the equations give K(ω − k dy/dτ) = Kω − k dy/dt. With the filter run in the dilated time
(its rate multiplied by K) the two are the same. :func:`compare_figure` shows both in numbers.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy as sp

from ptproof.problem import Problem
from ptproof.simulation import block_diagram, simulate, to_function
from ptproof.simulation.drawing import BLUE, new_figure
from ptproof.system import System


def washout_transfer(problem: Problem) -> Any:
    """The filter as the figure prints it: the transfer function s/(μs + 1)."""
    import control

    return control.tf([1, 0], [float(problem.tuning.mu), 1])


@dataclass(frozen=True)
class FigureComparison:
    """How far the block diagram is from eq:closed_loop_system_t.

    ``rhs_dilated`` and ``rhs_drawn`` are the largest relative differences of the right-hand sides over the points that
    were tried, with the filter in dilated time and as drawn; ``final_equations`` and ``final_drawn`` the distances
    from the source at T, and ``largest_gap`` the largest distance between the two paths.
    """

    rhs_dilated: float
    rhs_drawn: float
    final_equations: float
    final_drawn: float
    largest_gap: float


def compare_figure(problem: Problem, points: int = 50, seed: int = 0) -> FigureComparison:
    """Both readings of the figure against the closed loop: right-hand sides at random points, and the whole runs."""
    loop = problem.closed_loop("pt", "t")
    function = to_function(loop)
    drawings = [block_diagram(problem, dilated_filter=dilated) for dilated in (True, False)]
    draw = np.random.default_rng(np.random.SeedSequence(seed))
    start, T = float(problem.tuning.t0), float(problem.tuning.T)
    worst = [0.0, 0.0]
    for _ in range(points):
        time, state = start + T * draw.random(), draw.normal(size=4)
        truth = np.array(function(time, state, [])).ravel()
        for i, drawing in enumerate(drawings):
            gap = np.abs(drawing.dynamics(time, state, []) - truth) / (1 + np.abs(truth))
            worst[i] = max(worst[i], float(gap.max()))
    equations = simulate(problem, samples=2000)
    initial = [*(float(v) for v in problem.initial.x), float(problem.initial.theta), float(problem.measured)]
    as_drawn = drawn_loop(problem).with_values(problem.values)
    drawn = simulate(as_drawn, initial=initial, span=(start, start + T), samples=2000)
    source = np.array([float(value) for value in problem.source])
    on_grid = np.array([np.interp(equations.t, drawn.t, row) for row in drawn.x[:2]])
    return FigureComparison(
        worst[0], worst[1], equations.final_distance, float(np.linalg.norm(drawn.x[:2, -1] - source)),
        float(np.max(np.linalg.norm(on_grid - equations.x[:2], axis=0))),
    )  # fmt: skip


def drawn_loop(problem: Problem) -> System:
    """The figure as drawn, as a system: the closed loop with the filter's rate not multiplied by K(t)."""
    loop = problem.closed_loop("pt", "t", symbolic=True)
    rhs = [*loop.rhs]
    rhs[-1] = sp.cancel(rhs[-1] / problem.seeker_clock().rate)
    return System(loop.time, loop.state, tuple(rhs), name="block diagram as drawn")


def draw() -> Any:
    """The closed loop as blocks (fig:unicycle_pt_controller), with the filter that makes it eq:closed_loop_system_t.

    The paper draws s/(μs + 1) in t; the loop of the equations has that filter run in the dilated time.
    """
    figure, ax = new_figure(size=(7.2, 3.4))
    ax.set(xlim=(0, 12), ylim=(0, 5.6))
    ax.axis("off")
    boxes = {
        "K(t)": (1.7, 4.4, 1.0), "ẋ = f(t, x) + u₁ (cos θ, sin θ)\nθ̇ = u₂": (5.0, 3.9, 3.4), "F(x)": (8.2, 3.9, 1.1),
        "s/(μs + 1)\nin τ": (10.6, 3.9, 1.6), "−k": (8.2, 1.0, 1.0), "+": (5.2, 1.0, 0.6), "K(t) ": (2.6, 1.0, 1.0),
    }  # fmt: skip
    for label, (x, y, width) in boxes.items():
        style = {"boxstyle": "round,pad=0.02", "facecolor": "white", "edgecolor": BLUE}
        height = 1.5 if "ẋ" in label else 1.0 if "\n" in label else 0.8
        ax.add_patch(_box(x, y, width, height, style))
        ax.text(x, y, label.strip(), ha="center", va="center", fontsize=9)
    arrows = [
        ([(0.3, 4.4), (1.2, 4.4)], "√ω", (0.5, 4.6)), ([(2.2, 4.4), (3.3, 4.4)], "u₁", (2.7, 4.6)),
        ([(6.7, 3.9), (7.65, 3.9)], "x", (7.1, 4.1)), ([(8.75, 3.9), (9.8, 3.9)], "y", (9.2, 4.1)),
        ([(10.6, 3.4), (10.6, 1.0), (8.7, 1.0)], "(y − z)/μ", (9.1, 1.2)), ([(7.7, 1.0), (5.5, 1.0)], "", (0, 0)),
        ([(5.2, 0.1), (5.2, 0.6)], "ω", (5.35, 0.15)), ([(4.9, 1.0), (3.1, 1.0)], "", (0, 0)),
        ([(2.1, 1.0), (1.5, 1.0), (1.5, 3.5), (3.3, 3.5)], "u₂", (2.4, 3.65)),
    ]  # fmt: skip
    for points, label, place in arrows:
        xs, ys = zip(*points, strict=True)
        ax.plot(xs[:-1], ys[:-1], color="black", lw=0.9)
        ax.annotate("", points[-1], points[-2], arrowprops={"arrowstyle": "-|>", "color": "black", "lw": 0.9})
        ax.text(*place, label, fontsize=9)
    return figure


def _box(x: float, y: float, width: float, height: float, style: dict[str, Any]) -> Any:
    from matplotlib.patches import FancyBboxPatch

    return FancyBboxPatch((x - width / 2, y - height / 2), width, height, **style)
