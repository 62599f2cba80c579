"""Section 7 and Fig. 1: every claim comes out as recorded, and no corrupted twin of a proved one is proved."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from types import ModuleType

import pytest
import sympy as sp

from ptproof.proof.claim import Claim
from ptproof.proof.deciding import run_one
from ptproof.proof.load import load
from ptproof.proof.statement import All, Exists, Relation, Smooth, eq, ge, gt, le, lt
from ptproof.proof.verdict import Verdict

FOLDER = Path(__file__).parents[2] / "derivations" / "pt_seeker"
FILES = (
    "section4_figure1", "section7_clipping", "section7a_vanishing", "section7b_nonvanishing", "section7c_saturated",
    "section7d_examples", "section7e_averages",
)  # fmt: skip
FOUND = {claim.id: claim for claim in load([FOLDER / f"{name}.py" for name in FILES]).claims}
MODULES = {claim.prove.__module__.rpartition(".")[2]: sys.modules[claim.prove.__module__] for claim in FOUND.values()}
CLAIMS = {id: claim for id, claim in FOUND.items() if claim.prove.__module__.rpartition(".")[2] in FILES}
fig, clip, one, two, three, _, mean = (MODULES[name] for name in FILES)
R, pi = sp.Rational, sp.pi
REFUTED, UNDECIDED = Verdict.REFUTED, Verdict.UNDECIDED


def given(id: str, *assumptions: Relation) -> Claim:
    return replace(CLAIMS[id], assumptions=assumptions)


def says(id: str, statement: Relation | All | Exists | Smooth) -> Claim:
    return replace(CLAIMS[id], statement=statement)


def sides(id: str, change: dict[sp.Basic, sp.Basic]) -> Claim:
    """The right-hand sides changed."""
    statement = CLAIMS[id].statement
    parts = statement.parts if isinstance(statement, All) else (statement,)
    return says(id, All(tuple(Relation(part.left, part.sign, part.right.subs(change)) for part in parts)))


def smooth_after(module: ModuleType, id: str) -> Claim:
    """With a kink added that has a first derivative and no second."""
    old = CLAIMS[id].statement
    x1 = module.position[0]
    return says(id, replace(old, expressions=(old.expressions[0] + x1 * sp.Abs(x1), *old.expressions[1:])))


t, t0, T = clip.t, clip.t0, clip.T
x1, x2 = one.position
lam = one.eigenvalue
S, C, u2, eps = three.S, three.C, three.u2, three.epsilon
wrong_law = three.C * (three.omega + three.k / three.mu * (three.y - three.z))
square = x1**2 + x2**2

TWINS = [
    # Fig. 1
    (says("4/washout-realisation", eq(fig.transfer_function, fig.laplace / (fig.mu * fig.laplace - 1))), REFUTED),
    (says("4/washout-realisation", eq(fig.transfer_function, 1 / (fig.mu * fig.laplace + 1))), REFUTED),
    (
        says("4/washout-differentiates", eq(sp.Limit(fig.laplace / (fig.mu * fig.laplace + 1), fig.mu, 0, "+"), 1)),
        REFUTED,
    ),
    (says("4/figure-corrected", eq(fig.block_diagram(fig.gain**2).vector, fig.closed_loop_t.vector)), REFUTED),
    (says("4/figure-corrected", eq(fig.block_diagram(-fig.gain).vector, fig.closed_loop_t.vector)), REFUTED),
    # The clipped gain
    (says("7/clipped-gain", eq(clip.gain, sp.Min(1 / R("0.3"), 1 / clip.nu(t - t0) ** 2))), REFUTED),
    (says("7/clipped-gain", eq(clip.gain, sp.Max(1 / R("0.3") ** 2, 1 / clip.nu(t - t0) ** 2))), REFUTED),
    (given("7/clipped-gain", ge(t, t0)), REFUTED),
    (says("7/clipped-gain-simulated", eq(clip.prescribed_time_gain(clip.clock, R("0.4")), clip.gain)), REFUTED),
    (says("7/clipped-gain-simulated", eq(clip.prescribed_time_gain(clip.clock, R("0.3")), clip.printed_gain)), REFUTED),
    (given("7/clipped-gain-afterwards", gt(t, t0 + T)), REFUTED),
    (says("7/clipped-gain-finite", le(clip.printed_gain, 1 / R("0.3"))), REFUTED),
    (given("7/clipped-gain-final", ge(t, t0 + R("0.6") * T)), REFUTED),
    (says("7.3/largest-gain-rounded", le(sp.Abs(1 / clip.minimum**2 - R("11.12")), clip.half_unit)), REFUTED),
    (sides("7/inputs-bounded", {clip.spread: -clip.spread}), REFUTED),
    (sides("7/inputs-bounded", {clip.omega: clip.omega / 2}), REFUTED),
    (given("7/inputs-bounded", le(clip.y - clip.z, clip.spread)), REFUTED),
    (says("7/inputs-unbounded", eq(sp.Limit(clip.law.forward, t, t0 + T, "-"), sp.oo)), UNDECIDED),
    # 7.1
    (says("7.1/peak", eq(one.field, R("2.5"))), REFUTED),
    (given("7.1/maximum", ge(square, 0)), REFUTED),
    (says("7.1/maximum", lt(one.field + x1**2, one.peak)), REFUTED),
    (given("7.1/critical-point", eq(x1, 0), eq(x2, 1)), REFUTED),
    (smooth_after(one, "7.1/smooth"), REFUTED),
    (given("7.1/radially-unbounded", ge(square, one.level)), REFUTED),
    (says("7.1/field-bounds", le(one.peak - (one.upper - R(1, 10)) * square, one.field)), REFUTED),
    (says("7.1/field-bounds", le(one.field, one.peak - R("0.51") * square)), REFUTED),
    (says("7.1/ripple", ge(R("0.47") * x1 + pi / 3 * sp.sin(one.wave), 0)), REFUTED),
    (given("7.1/ripple", le(x1, 3)), REFUTED),
    (says("7.1/gradient-bounds", le(R("0.6") * one.norm_x, one.norm(one.slope))), REFUTED),
    (says("7.1/gradient-bounds", le(one.norm(one.slope), 2 * one.norm_x)), REFUTED),
    (says("7.1/drift-matrix-corrected", eq(one.derivative, sp.diag(2 * pi**2 / 9, 1))), REFUTED),
    (says("7.1/eigenvalue-1-of-print", le(sp.Abs(one.printed_matrix[0, 0] - R("4.20")), one.half_unit)), REFUTED),
    (given("7.1/eigenvalue-1-exact", one.characteristic), REFUTED),
    (says("7.1/eigenvalue-1-rounded", le(sp.Abs(one.largest - R("3.20")), one.half_unit)), REFUTED),
    (given("7.1/eigenvalue-1-corrected", one.characteristic), REFUTED),
    (given("7.1/eigenvalue-2", eq(lam, 2)), REFUTED),
    (says("7.1/unstable", gt(lam, 2)), REFUTED),
    (given("7.1/drift-vanishes", eq(x1, 0)), REFUTED),
    (smooth_after(one, "7.1/drift-smooth"), REFUTED),
    (given("7.1/k-too-small", *CLAIMS["7.1/k-too-small"].assumptions[:-1]), REFUTED),
    (says("7.1/k-too-small", le(R("1.8"), 4 / CLAIMS["7.1/k-too-small"].statement.right)), REFUTED),
    # 7.2
    (says("7.2/peak", eq(two.field, 1)), REFUTED),
    (given("7.2/maximum", ge(square, 0)), REFUTED),
    (given("7.2/critical-point", eq(x1, 0), eq(x2, 1)), REFUTED),
    (smooth_after(two, "7.2/smooth"), REFUTED),
    (given("7.2/radially-unbounded", ge(square, R(1, 10))), REFUTED),
    (says("7.2/field-lower", le(two.field, two.peak - R("0.7") * square)), REFUTED),
    (given("7.2/field-upper", le(square, two.radius**2 + 1)), REFUTED),
    (says("7.2/field-upper", le(two.peak - two.radius**2 / 2 * square, two.field)), REFUTED),
    (given("7.2/slope-along-axis"), REFUTED),
    (says("7.2/slope-along-axis", ge(sp.sin(x1) + x1**3 / 7, x1)), REFUTED),
    (says("7.2/gradient-lower", le(R(13, 10) * sp.sqrt(square), one.norm(two.slope))), REFUTED),
    (says("7.2/slope-along-axis-upper", le(two.slope[0] ** 2, 4 * two.radius**4 * x1**2)), REFUTED),
    (says("7.2/gradient-upper", le(one.norm(two.slope), 2 * two.radius**2 * sp.sqrt(square))), REFUTED),
    (given("7.2/assumption-2-on-discs"), REFUTED),
    (sides("7.2/drift-bound", {two.largest_bound: sp.sqrt(2)}), REFUTED),
    (says("7.2/drift-bound", le(two.strength, 1 + sp.sin(3 * t))), REFUTED),
    (given("7.2/drift-bound-attained", eq(t, pi / 3), *two.at_source), REFUTED),
    (says("7.2/drift-nonvanishing", eq(sp.Matrix(two.drift.rate), [1, -1])), REFUTED),
    (given("7.2/drift-pauses", eq(t, pi / 6)), REFUTED),
    (says("7.2/drift-instants", lt(2 * pi / 3, 2)), REFUTED),
    (smooth_after(two, "7.2/drift-smooth"), REFUTED),
    (given("7.1/asymptotic-average-leaves"), REFUTED),
    (says("7.1/asymptotic-average-leaves", gt(mean.prescribed.derivative_along(one.peak - one.field), 0)), REFUTED),
    (given("7.1/pt-average-climbs", *CLAIMS["7.1/pt-average-climbs"].assumptions[:-1]), REFUTED),
    (says("7.1/pt-average-climbs", lt(mean.asymptotic.derivative_along(one.peak - one.field), 0)), REFUTED),
    # 7.3
    (says("7.3/saturated-seeker", eq(three.seeker.vector, [*three.seeker.vector[:3], wrong_law, 0])), REFUTED),
    (sides("7.3/saturation", {S: S / 2}), REFUTED),
    (given("7.3/saturation-identity", le(three.signal, S)), REFUTED),
    (says("7.3/steady-state", eq(u2, wrong_law)), REFUTED),
    (given("7.3/steady-state", le(three.acceleration, 0)), REFUTED),
    (given("7.3/steady-state-is-one", eq(u2, wrong_law)), REFUTED),
    (says("7.3/steady-state-feedback", eq(u2, wrong_law.subs(C, 1 / clip.nu(t - t0) ** 2))), UNDECIDED),
    (says("7.3/signal-at-4", le(sp.Abs(eps * three.acceleration).subs(S, 5), 4)), REFUTED),
    (says("7.3/acceleration-bound", le(sp.Abs(three.acceleration), S)), REFUTED),
    (says("7.3/acceleration-at-10000", le(sp.Abs(three.acceleration.subs(three.chosen)), 9_999)), REFUTED),
    (says("7.3/constant-gain", lt(R("11.12"), 1 / R("0.3") ** 2)), REFUTED),
    (says("7.3/peak", eq(three.field, 1)), REFUTED),
    (given("7.3/maximum", ge(square, 0)), REFUTED),
    (smooth_after(three, "7.3/smooth"), REFUTED),
    (given("7.3/radially-unbounded", ge(square, three.level)), REFUTED),
]
for name in ("7.1/as-simulated", "7.2/as-simulated", "7.3/as-simulated"):
    TWINS += [(sides(name, {clip.minimum: R("0.2")}), REFUTED), (sides(name, {x1: x1 / 2}), REFUTED)]
EXISTENCE = ["7.1/assumption-2", "7.3/assumption-2"]


@pytest.mark.parametrize("claim", CLAIMS.values(), ids=CLAIMS.keys())
def test_claim_comes_out_as_recorded(claim):
    evidence = run_one(claim)
    assert evidence.verdict is claim.expected, evidence.detail


@pytest.mark.parametrize(("twin", "verdict"), TWINS, ids=[f"{twin.id}-{i}" for i, (twin, _) in enumerate(TWINS)])
def test_corrupted_twin_is_not_proved(twin, verdict):
    evidence = run_one(twin)
    assert evidence.engine != "crash", evidence.detail
    assert evidence.verdict is verdict, evidence.detail


@pytest.mark.parametrize("id", EXISTENCE)
@pytest.mark.parametrize("index", range(4))
def test_assumption_2_with_a_bound_reversed_is_not_proved(id, index):
    old = CLAIMS[id].statement
    body = list(old.body)
    body[index] = Relation(body[index].right * R(1, 2), "<=", body[index].left - 1)
    assert run_one(says(id, replace(old, body=tuple(body)))).verdict is not Verdict.PROVED


def test_every_proved_claim_has_a_twin():
    proved = {id for id, claim in CLAIMS.items() if claim.expected is Verdict.PROVED}
    assert proved == {twin.id for twin, _ in TWINS} | set(EXISTENCE)
