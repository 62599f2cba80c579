"""What a reader of the report may move: the gain conditions, the critical start, the clipped gain, the vehicles."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import sympy as sp

from ptproof.problem import Problem
from ptproof.problem.drift import gradient_drift
from ptproof.report.instruments import (
    Condition,
    Curve,
    Instrument,
    Plot,
    Quantity,
    Region,
    Slider,
    command,
    taken,
    vehicle,
)

from . import chain
from .notation import R0, V0, E_norm, T, a1, a2, b1, b2, c, d, k, mu, omega, t, t0, tau
from .section5a_2_averaging import averaged_system
from .section5b_1_lyapunov import n
from .section5b_2_gradient_drift import distance_at, lag
from .section5d_1_interval import input_gain, second
from .section5d_2_estimates import kappa_1
from .section5d_3_trajectory import distance_at as distance_of_x
from .section5d_3_trajectory import named, solution_1
from .section6a_asymptotic import distance_bound_in_t, drift_slows, gain_condition, gain_threshold
from .section6b_1_comparison import C1, C2, W, remark_inequality
from .section6b_2_critical import critical_value, tau_star
from .section6b_2_finite import drift_root, feed_root, finite_small_start, finite_under_condition
from .section6c_feasibility import asymptotic_iss, lowest
from .section6d_2_clipped_bounded import distance_then
from .section6d_clipped import gain_after, total_time
from .section6d_clipped_trajectory import distance_final
from .section6e_after_the_clip import closer_after_corrected
from .section7d_examples import (
    nonvanishing,
    nonvanishing_as_simulated,
    saturated,
    vanishing,
    vanishing_as_simulated,
)
from .section7g_vehicle import unsaturated_vehicle

kappa = sp.Symbol("kappa", integer=True, positive=True)


def constants(*starts: str) -> tuple[Slider, ...]:
    """The field's constants."""
    return tuple(
        Slider(letter, "0.05", 10, first, logarithmic=True)
        for letter, first in zip((a1, a2, b1, b2), starts, strict=True)
    )


quadratic, steep = constants("0.6", "0.5", "1", "1.2"), constants("1.5", "0.5", "1.4", "3.3")
gain = Slider(k, "0.1", 20, "1.8", logarithmic=True)
horizon = Slider(T, "0.1", 10, 1, logarithmic=True)
drift_gain = Slider(E_norm, 0, 5, 1)
clip = Slider(lowest, "0.02", "0.98", "0.3", glyph=r"\nu_{\min}", unit="1", meaning="least ν of the clipped gain")
order = Slider(kappa, 2, 5, 2, meaning="order of the field's bounds", unit="1", glyph=r"\kappa")
start = Slider(R0, "0.05", 10, "2.83", logarithmic=True)
GIVEN = " ".join(f"--{name} {{{name}}}" for name in ("a1", "a2", "b1", "b2"))
TIME, DISTANCE = r"t\ [\text{s}]", r"\|\bar x - x^*\|\ [\text{m}]"
BEGUN = {t0: sp.S.Zero}


def instruments() -> Iterator[Instrument]:
    """Section 5 to 7, by what may be moved."""
    yield _gain()
    yield _critical()
    yield _clipped()
    yield _bounded()
    yield from _vehicles()


def _gain() -> Instrument:
    sliders = (gain, drift_gain, horizon, start, *quadratic)
    take = partial(taken, sliders=sliders)
    return Instrument(
        "gain", "Gain against drift (κ = 1)",
        "The asymptotic seeker needs a gain above a threshold that grows with the drift; the averaged PT Seeker comes "
        "to the source by T for every gain, with a bound that the drift enlarges. All of it is about the average.",
        sliders,
        (
            Condition("The gain condition of the asymptotic seeker", take(gain_condition, assumed=True)),
            Quantity("Its threshold for k", take(gain_threshold), "left", "1/[F]", "asymptotic.k_min_printed"),
            Region("Where the asymptotic seeker's condition holds", E_norm, k, (take(gain_condition),)),
            Plot(
                "The distance of the averaged PT Seeker is at most", t, 0, T,
                (
                    Curve("with the drift", take(distance_bound_in_t, at=BEGUN, short={R0: distance_at(t0)})),
                    Curve("without drift", take(drift_slows, at=BEGUN), "left"),
                ),
                TIME, DISTANCE,
            ),
        ),
        f"ptproof gains --kappa 1 {GIVEN} --drift-norm {{E_norm}} --k {{k}} --T {{T}}",
    )  # fmt: skip


def _critical() -> Instrument:
    sliders = (order, gain, drift_gain, horizon, Slider(V0, "0.001", 20, "0.005", logarithmic=True), *steep)
    take = partial(taken, sliders=sliders)
    at = {C1: c(1, kappa), C2: c(2, kappa), n: kappa - 1, t0: sp.S.Zero}
    turn = (T * (drift_root / feed_root - 1)).subs({C1: at[C1], C2: at[C2]})
    small = {**at, W: V0 ** (1 - 1 / kappa), tau: lag}
    on_the_clock = {**at, tau: chain.clock.to_tau.subs(t0, 0)}
    finite = take(finite_small_start, at={**small, tau: on_the_clock[tau]})
    return Instrument(
        "critical", "The critical start (κ ≥ 2)",
        "Under a drift along the gradient the bound of V may escape to infinity before the prescribed time, unless the "
        "start is close enough to the source, T short enough, or the gain large enough. The curve stops where the "
        "bound escapes.",
        sliders,
        (
            Quantity(
                "The smallest critical V(x₀): below it the bound stays finite",
                take(critical_value, at={**at, tau_star: turn}, assumed=True, part=2), "right", "[F]",
                "critical.V0_threshold_printed",
            ),
            Condition("The start is below it", take(finite_small_start, at=small, assumed=True, part=2)),
            Condition("The gain wins from every start", take(finite_under_condition, at=small, assumed=True, part=1)),
            Region(
                "Where the bound stays finite", T, V0,
                (take(finite_small_start, at=small), take(finite_under_condition, at=small)),
            ),
            Region(
                "Where it stays finite, against the drift", E_norm, V0,
                (take(finite_small_start, at=small), take(finite_under_condition, at=small)),
            ),
            Plot(
                "V of the average is at most", t, 0, T * sp.Rational(999, 1000),
                (Curve("the bound, as long as its denominator is positive", take(remark_inequality, at=on_the_clock),
                       within=(finite,)),),
                TIME, r"V\ [F]",
            ),
        ),
        f"ptproof gains --kappa {{kappa}} {GIVEN} --drift-norm {{E_norm}} --k {{k}} --T {{T}} --V0 {{V0}}",
    )  # fmt: skip


def _clipped() -> Instrument:
    sliders = (clip, gain, drift_gain, horizon, start, *quadratic)
    take = partial(taken, sliders=sliders)
    final = take(distance_final, at=BEGUN, short={R0: distance_then(t0)})
    return Instrument(
        "clip", "The clipped gain (κ = 1)",
        r"With $\nu$ kept above $\nu_{\min}$ the inputs stay bounded, and the average ends within a distance of the "
        "source instead of at it.",
        sliders,
        (
            Quantity("At T the average is within", final, "right", "m", "clip.residual_bound_printed"),
            Quantity("The dilated time that passes", take(total_time, at=BEGUN), "right", "s", "clip.tau_end"),
            Quantity("The gain 1/ν² at the end", take(gain_after, at={**BEGUN, t: T}), "right", "1"),
            Condition("After the clip V still falls", take(closer_after_corrected, assumed=True, part=3)),
            Plot("At the prescribed time the average is within", lowest, clip.lowest, clip.highest,
                 (Curve("bound for every ν_min", final),), r"\nu_{\min}", DISTANCE, logarithmic=True),
        ),
        f"ptproof gains --kappa 1 {GIVEN} --drift-norm {{E_norm}} --k {{k}} --T {{T}} --nu-min {{nu_min}} "
        "--x0-norm {R0}",
    )  # fmt: skip


def _bounded() -> Instrument:
    sliders = (gain, horizon, Slider(d, 0, 5, "0.5"), start, *quadratic)
    take = partial(taken, sliders=sliders)
    one = sp.S.One
    return Instrument(
        "bounded-drift", "A drift that does not vanish (κ = 1)",
        "A drift of at most ‖d‖ keeps the averaged asymptotic seeker away from the source; the averaged PT Seeker "
        "comes to it by T all the same.",
        sliders,
        (
            Plot(
                "The distance is at most", t, 0, T * sp.Rational(999, 1000),
                (
                    Curve("PT Seeker, by the Proposition's proof",
                          take(solution_1[2], at=BEGUN, short={R0: distance_of_x(t0)})),
                    Curve("asymptotic seeker", take(asymptotic_iss[0], at=BEGUN, short={R0: distance_of_x(t0)})),
                ),
                TIME, DISTANCE,
            ),
            Quantity("γ(h₂‖d‖): what a lasting drift leaves", take(named(kappa_1, "gamma-class-k"),
                     at={second: input_gain(one) * d}, part=2), "right", "m", "nonvanishing.gamma"),
        ),
        f"ptproof gains --kappa 1 {GIVEN} --drift-bound {{d}} --k {{k}} --T {{T}} --x0-norm {{R0}}",
    )  # fmt: skip


def _vehicles() -> Iterator[Instrument]:
    x, y, heading = sp.symbols("x_start y_start heading", real=True)
    moved = {"x1": x, "x2": y, "theta": heading}

    def sliders(problem: Problem, *more: Slider) -> tuple[Slider, ...]:
        tuning, (first, second) = problem.tuning, problem.initial.x
        return (
            Slider(k, "0.2", 6, tuning.k), Slider(T, "0.2", 4, tuning.T),
            Slider(omega, 5, 300, tuning.omega, logarithmic=True),
            Slider(mu, "0.0005", "0.1", tuning.mu, logarithmic=True),
            Slider(lowest, "0.1", "0.95", tuning.nu_min, glyph=r"\nu_{\min}", unit="1", meaning="least ν of the gain"),
            *more, Slider(x, -3, 3, first, glyph="x_1(t_0)", unit="m", meaning="start"),
            Slider(y, -3, 3, second, glyph="x_2(t_0)", unit="m", meaning="start"),
            Slider(heading, "-3.14", "3.14", 0, glyph=r"\theta(t_0)", unit="rad", meaning="heading at the start"),
        )  # fmt: skip

    push = gradient_drift([[-E_norm, 0], [0, -E_norm]], vanishing.field.expression, vanishing.variables)
    for name, title, problem, claimed, more, drift in (
        ("vanishing", "The vehicle beside its average: vanishing drift (Section 7.1)", vanishing,
         vanishing_as_simulated, (Slider(E_norm, 0, 3, 1, meaning="drift gain: the drift is −‖E‖∇F"),), push),
        ("nonvanishing", "The vehicle beside its average: a drift that does not vanish (Section 7.2)", nonvanishing,
         nonvanishing_as_simulated, (), None),
        ("unsaturated", "The vehicle beside its average: no drift, without the saturation (Section 7.3)", saturated,
         unsaturated_vehicle, (), None),
    ):  # fmt: skip
        yield Instrument(
            name, title,
            "The closed loop and its Lie bracket average, integrated here in the dilated time, where the run up to T "
            "is regular, and shown in t. Nothing about the vehicle is proved by looking at it.",
            sliders(problem, *more),
            (vehicle(problem, "Vehicle and average", (claimed, averaged_system), moved, drift),),
            command(problem, moved, drift),
        )  # fmt: skip
