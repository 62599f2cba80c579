"""The Proposition and Section 6: no corrupted twin of a proved claim is proved, and the false ones that a point shows
to be false are refuted."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import pytest
import sympy as sp

import ptproof.proof.engines.reals
import ptproof.proof.settling
from ptproof.proof.claim import Claim
from ptproof.proof.deciding import run_one
from ptproof.proof.engines.witnesses import refute
from ptproof.proof.load import load
from ptproof.proof.statement import All, Exists, ForAll, Relation, eq, ge, gt, le, lt
from ptproof.proof.verdict import Verdict

FOLDER = Path(__file__).parents[2] / "derivations" / "pt_seeker"
NAMES = (
    "section5c_proposition", "section5d_1_interval", "section5d_2_estimates", "section6a_asymptotic",
    "section6b_1_comparison", "section6b_2_critical", "section6c_feasibility",
)  # fmt: skip
FOUND = {claim.id: claim for claim in load([FOLDER / f"{name}.py" for name in NAMES]).claims}
MODULES = {claim.prove.__module__.rpartition(".")[2]: sys.modules[claim.prove.__module__] for claim in FOUND.values()}
prop, est, whole, asy, bound, crit, feas = (MODULES[name] for name in NAMES)
OWN = [claim for claim in FOUND.values() if claim.prove.__module__.rpartition(".")[2] in NAMES]


def says(id: str, statement: Relation | All | Exists) -> Claim:
    return replace(FOUND[id], statement=statement)


def without(id: str, *dropped: int) -> Claim:
    """With the assumptions at these positions dropped."""
    old = FOUND[id].assumptions
    return replace(FOUND[id], assumptions=tuple(item for i, item in enumerate(old) if i not in dropped))


def scaled(id: str, factor: object, part: int = 0) -> Claim:
    """With one right-hand side multiplied."""
    statement = FOUND[id].statement
    parts = list(statement.parts if isinstance(statement, All) else (statement,))
    parts[part] = Relation(parts[part].left, parts[part].sign, parts[part].right * factor)
    return says(id, All(tuple(parts)) if isinstance(statement, All) else parts[0])


def right(id: str, change: dict[sp.Basic, sp.Basic]) -> Claim:
    """With symbols of the right-hand side changed."""
    old = FOUND[id].statement
    return says(id, Relation(old.left, old.sign, old.right.subs(change)))


def forced(id: str, position: int, change: dict[sp.Basic, sp.Basic]) -> Claim:
    """With the rate of the differential inequality changed."""
    old = FOUND[id].assumptions[position]
    assert isinstance(old, ForAll)
    rate = Relation(old.relation.left, old.relation.sign, old.relation.right.subs(change))
    new = [*FOUND[id].assumptions]
    new[position] = replace(old, relation=rate)
    return replace(FOUND[id], assumptions=tuple(new))


half, k, T, t, t0, tau = sp.Rational(1, 2), prop.k, prop.T, prop.t, prop.t0, prop.tau
V, U, R, a1, a2 = prop.V, prop.U, prop.R, prop.a1, prop.a2
d, E_norm, kappa = prop.d, asy.E_norm, prop.kappa
ONE, TWO = sp.Integer(1), est.m + 1
both = [("kappa-1", ONE), ("kappa-2", TWO)]
theta = prop.share
W, n, sigma = bound.W, bound.n, bound.sigma
REFUTED = Verdict.REFUTED

# κ ≥ 2 takes longer, so there each claim gets one or two twins.
ENOUGH = {
    "gamma-decreasing", "gamma-without-order", "decay-antitone", "decay-without-order", "beta-stays",
    "beta-grows-with-time", "u-without-the-level", "bound-without-order-of-constants",
    "first-half-twice-as-long", "second-half-undamped-less", "finale-without-X", "finale-in-t-other-clock", "limit-one",
    "convergence-without-the-inequality", "convergence-to-one", "iss-larger-drift",
}  # fmt: skip
# Each row: a name, the corrupted claim, and the verdict that it must have (None: anything but proved).
TWINS = [
    ("drift-sign-in-t", scaled("prop/averaged-in-t", -1), REFUTED),
    ("bounded-drift-without-bound", without("prop/bounded-drift", 1), REFUTED),
    ("bounded-drift-half", right("prop/bounded-drift", {d: d / 2}), None),
    ("u-is-another-root", says("prop/u-substitution", eq(V ** (1 - prop.q()), V ** (1 / kappa))), REFUTED),
    ("h1-doubled", says("prop/u-inequality", le(
        FOUND["prop/u-inequality"].statement.left, -2 * prop.h1 * prop.U_of_V ** (2 * kappa - 1)
        + prop.h2 * d / prop.stretch**2)), REFUTED),
    ("h2-halved", right("prop/u-inequality", {d: d / 2}), REFUTED),
    ("u-bounds-swapped", says("prop/u-bounds", le(a1 ** (1 / (2 * kappa)) * R, prop.U_of_V)), REFUTED),
    ("constants-swapped", says("prop/constants-ordered", le(a1, a2)), REFUTED),
    ("u-distance-upper", says("prop/u-inequality-in-distance", le(
        prop.U_dot, -prop.h1 * a1 ** (prop.r / (2 * kappa)) * R**prop.r + sp.Abs(prop.zeta))), None),
    ("decrease-with-all-of-it", says("prop/decrease", le(prop.U_dot, -prop.h1 * prop.strength * R**prop.r)), None),
    ("decrease-other-share", right("prop/decrease", {theta: theta / 2}), None),
    ("decrease-below-the-threshold", without("prop/decrease", 2), REFUTED),
    ("no-increase-strictly", says("prop/decrease-at-the-printed-threshold", lt(prop.U_dot, 0)), None),
    ("no-increase-below", without("prop/decrease-at-the-printed-threshold", 1), REFUTED),
    ("gain-without-its-share", scaled("prop/gain-of-the-cited-theorem", theta), REFUTED),
    ("zeta-second-half", scaled("prop/zeta-suprema", half, 1), REFUTED),
    ("zeta-before-the-start", without("prop/zeta-suprema", 1), REFUTED),
    ("input-stays", says("prop/input-vanishes", eq(FOUND["prop/input-vanishes"].statement.left, 1)), REFUTED),
    *((f"{name}-{tag}", twin, verdict) for tag, order in both for name, twin, verdict in [
        ("gamma-decreasing", says(f"prop/gamma-class-k-{tag}", lt(
            est.gamma(est.second, order), est.gamma(est.low, order))), REFUTED),
        ("gamma-without-order", without(f"prop/gamma-class-k-{tag}", 0), REFUTED),
        ("decay-antitone", says(f"prop/decay-monotone-{tag}", le(
            est.decay(est.second, est.elapsed, order), est.decay(est.first, est.elapsed, order))), REFUTED),
        ("decay-without-order", without(f"prop/decay-monotone-{tag}", 0), REFUTED),
        ("beta-stays", says(f"prop/beta-zero-{tag}", eq(FOUND[f"prop/beta-zero-{tag}"].statement.left, 1)), REFUTED),
        ("beta-grows-with-time", says(f"prop/beta-class-kl-{tag}", gt(
            sp.diff(est.beta(est.low, est.elapsed, order), est.elapsed), 0)), REFUTED),
        ("u-level-halved", says(f"prop/u-estimate-{tag}", le(
            est.U_at(tau), est.decay(est.U_at(est.start), tau - est.start, order)
            + (est.Z / (2 * est.rate_of(order))) ** (1 / (2 * order - 1)))), None),
        ("u-without-the-level", says(f"prop/u-estimate-{tag}", le(
            est.U_at(tau), est.decay(est.U_at(est.start), tau - est.start, order))), None),
        ("u-backwards", without(f"prop/u-estimate-{tag}", 0), None),
        ("u-larger-input", forced(f"prop/u-estimate-{tag}", 1, {est.Z: 2 * est.Z}), None),
        ("gain-halved", says(f"prop/upper-bound-{tag}", le(
            est.distance(tau), est.beta(est.distance(est.start), tau - est.start, order)
            + est.gamma(est.Z, order) / 2)), None),
        ("bound-without-order-of-constants", without(f"prop/upper-bound-{tag}", 2), None),
        ("bound-without-the-lower-root", without(f"prop/upper-bound-{tag}", 3), None),
        ("bound-without-the-upper-root", without(f"prop/upper-bound-{tag}", 4), None),
        ("first-half-twice-as-long", says(f"prop/upper-bound-first-half-{tag}", le(
            est.distance(est.half), est.beta(est.distance(t0), tau - t0, order)
            + est.gamma(est.input_gain(order) * d, order))), None),
        ("second-half-undamped-less", says(f"prop/upper-bound-second-half-{tag}", le(
            est.distance(tau), est.beta(est.distance(est.half), (tau - t0) / 2, order)
            + est.gamma(est.zeta_at(tau, order), order))), None),
        ("finale-half-of-X", right(f"prop/finale-{tag}", {est.middle_bound: est.middle_bound / 2}), None),
        ("finale-without-X", without(f"prop/finale-{tag}", 0), None),
        ("finale-in-t-other-clock", without(f"prop/finale-in-t-{tag}", 3), None),
        ("limit-one", says(f"prop/finale-limit-{tag}", eq(
            FOUND[f"prop/finale-limit-{tag}"].statement.parts[1].left, 1)), REFUTED),
        ("convergence-without-the-inequality", without(f"prop/convergence-{tag}", 0), None),
        ("convergence-without-the-clock", without(f"prop/convergence-{tag}", 3), None),
        ("convergence-to-one", says(f"prop/convergence-{tag}", eq(
            FOUND[f"prop/convergence-{tag}"].statement.left, 1)), None),
        ("iss-gain-halved", says(f"6.3/asymptotic-global-iss-{tag}", le(
            est.distance(tau), est.beta(est.distance(t0), tau - t0, order)
            + est.gamma(est.input_gain(order) * d, order) / 2)), None),
        ("iss-larger-drift", forced(f"6.3/asymptotic-global-iss-{tag}", 1, {d: 2 * d}), None),
    ] if tag == "kappa-1" or name in ENOUGH),
    ("uniform-halved", scaled("prop/beta-uniform-kappa-2", half), REFUTED),
    ("gain-limit-zero", says("6/gain-limit", eq(FOUND["6/gain-limit"].statement.left, 0)), REFUTED),
    ("asymptotic-with-gain", says("6/asymptotic-seeker", eq(2 * asy.printed_asymptotic, asy.chain.asymptotic.vector)),
     REFUTED),
    ("asymptotic-limit-twice", says("6/asymptotic-seeker-is-the-limit", eq(
        FOUND["6/asymptotic-seeker-is-the-limit"].statement.parts[2].left, 2 * asy.printed_asymptotic[2])), REFUTED),
    ("asymptotic-derivative-k", right("6.2/asymptotic-derivative", {k: 4 * k}), None),
    ("asymptotic-average-k", says("6.2/averaged-asymptotic", eq(
        FOUND["6.2/averaged-asymptotic"].statement.left, 2 * asy.asymptotic_average.vector)), REFUTED),
    ("asymptotic-inequality-factor", says("6.2/asymptotic-inequality", le(
        asy.V_dot, (asy.C2**2 * E_norm - k * asy.C1**2) * V)), None),
    ("condition-half", replace(FOUND["6.2/gain-condition-suffices"], assumptions=(
        gt(k, (asy.C2 / asy.C1) ** 2 * E_norm),)), REFUTED),
    ("condition-with-equality", replace(FOUND["6.2/gain-condition-suffices"], assumptions=(
        ge(k, 2 * (asy.C2 / asy.C1) ** 2 * E_norm),)), None),
    ("condition-converse-stronger", says("6.2/gain-condition-is-needed-for-this", gt(
        k, 3 * (asy.C2 / asy.C1) ** 2 * E_norm)), REFUTED),
    ("threshold-positive-without-drift", without("6.2/gain-threshold-positive", 0), REFUTED),
    ("asymptotic-decay-faster", says("6.2/asymptotic-decay", le(
        asy.V_t(t), asy.V_t(t0) * sp.exp(2 * asy.coefficient * (t - t0)))), None),
    ("bound-in-t-halved", scaled("6.2/distance-bound-in-t", half), None),
    ("bound-in-t-faster", right("6.2/distance-bound-in-t", {k: 2 * k}), None),
    ("bound-in-t-limit", says("6.2/distance-bound-in-t-limit", eq(
        FOUND["6.2/distance-bound-in-t-limit"].statement.left, asy.R0)), REFUTED),
    ("drift-helps", says("6.2/drift-slows", le(asy.printed_in_t, asy.printed_in_t.subs(E_norm, 0))), REFUTED),
    ("drift-by-v-power", says("6.2/drift-by-v", le(bound.f_norm, bound.c(2) * E_norm * V ** (prop.q() / 2))), REFUTED),
    ("v-inequality-c2", says("6.2/v-inequality", le(
        bound.V_dot, V ** (2 * prop.q()) * (bound.c(2) * E_norm / prop.stretch**2 - k * bound.c(1) ** 2 / 2))),
        REFUTED),
    ("bernoulli-sigma", scaled("6.2/bernoulli", 2), None),
    ("bernoulli-integrated-half", says("6.2/bernoulli-integrated", le(
        bound.Y(tau), bound.Y(t0) + sigma * bound.work / 2)), None),
    ("denominator-gamma-0", says("6.2/denominator", eq(bound.denominator(W) + t0, bound.explicit)), REFUTED),
    ("remark-without-domain", without("6.2/remark-inequality", 2), None),
    ("remark-halved", scaled("6.2/remark-inequality", half), None),
    ("remark-sigma", says("6.2/remark-inequality", le(bound.V_away(tau), bound.V_away(t0) * (
        (tau - t0 + T) / bound.denominator(bound.V_away(t0) ** sigma)) ** sigma)), None),
    ("attained-with-double-rate", scaled("6.2/bound-attained", 2), REFUTED),
    ("escape-to-zero", says("6.2/bound-escapes", eq(FOUND["6.2/bound-escapes"].statement.left, 0)), None),
    ("denominator-start", says("6.2/denominator-shape", eq(bound.denominator(W, t0), 2 * T)), REFUTED),
    ("critical-sign", says("6.2/critical-v0-positive", lt(crit.critical_power, 0)), REFUTED),
    ("critical-weaker-condition", replace(FOUND["6.2/critical-v0-positive"], assumptions=(
        gt(crit.tau_star, t0), gt(E_norm, crit.threshold / 2))), REFUTED),
    ("critical-converse-stronger", says("6.2/critical-v0-condition", gt(E_norm, 2 * crit.threshold)), REFUTED),
    ("critical-other-root", replace(FOUND["6.2/critical-v0"], assumptions=(
        *FOUND["6.2/critical-v0"].assumptions[:2], eq(bound.V0, crit.critical_power))), None),
    ("critical-time-without-room", without("6.2/critical-time-near-start", 0), None),
    ("finite-under-half-the-condition", replace(FOUND["6.2/finite-under-gain-condition"], assumptions=(
        ge(tau, t0), gt(k, bound.C2**2 / bound.C1**2 * E_norm))), REFUTED),
    ("finite-before-the-start", without("6.2/finite-under-gain-condition", 0), REFUTED),
    ("finite-at-half-equality", replace(FOUND["6.2/finite-at-equality"], assumptions=(
        ge(tau, t0), eq(k, bound.C2**2 / bound.C1**2 * E_norm))), REFUTED),
    ("work-bound-halved", scaled("6.2/work-of-the-drift", half), REFUTED),
    ("start-twice-as-large", replace(FOUND["6.2/positive-for-a-small-start"], assumptions=(
        lt(sigma * W * T * (crit.A - crit.B) ** 2, 2),)), REFUTED),
    ("small-start-without-limit", without("6.2/finite-for-a-small-start", 2), REFUTED),
    ("smallest-critical-elsewhere", says("6.2/smallest-critical-value", eq(
        FOUND["6.2/smallest-critical-value"].statement.left, 1)), REFUTED),
    ("asymptotic-u-h2", right("6.3/asymptotic-u-inequality", {d: d / 2}), None),
    ("inputs-bounded", says("6.4/inputs-grow", eq(FOUND["6.4/inputs-grow"].statement.parts[0].left, 1)), None),
    ("gain-range-24", says("6.4/clipped-gain-range", le(1 / feas.lowest**2, 24)), None),
    ("clipping-time-whole", says("6.4/clipping-time", eq(prop.nu(T * (1 - feas.lowest)), 1 - feas.lowest)), REFUTED),
    ("dilated-time-off", scaled("6.4/clipped-dilated-time", 2), REFUTED),
]  # fmt: skip


@pytest.mark.parametrize(("twin", "verdict"), [row[1:] for row in TWINS], ids=[row[0] for row in TWINS])
def test_corrupted_twin(twin: Claim, verdict: Verdict | None, monkeypatch: pytest.MonkeyPatch) -> None:
    # A failed proof is what is expected here, so it may give up early; that can only lose proofs.
    monkeypatch.setattr(ptproof.proof.engines.reals, "SECONDS", 2.0)
    monkeypatch.setattr(ptproof.proof.settling, "SEARCH_SECONDS", 2.0 if verdict is Verdict.REFUTED else 0.0)
    found = run_one(twin)
    assert found.verdict is not Verdict.PROVED
    assert verdict is None or found.verdict is verdict, found.detail


def test_every_proved_claim_has_a_twin() -> None:
    twins = {row[1].id for row in TWINS}
    assert [claim.id for claim in OWN if claim.expected is Verdict.PROVED and claim.id not in twins] == []


def test_the_printed_decrease_holds_without_drift() -> None:
    """The witness needs the drift: without one the same point is none."""
    claim = FOUND["prop/decrease-printed"]
    values = {prop.F: -(prop.x1**2) - prop.x2**2, prop.f[0]: 0, prop.f[1]: 0, prop.x1: 1, prop.x2: 0,
              prop.source[0]: 0, prop.source[1]: 0, kappa: 1, k: 1, a1: 1, a2: 1, prop.b1: 2, prop.b2: 2, d: 0,
              T: 1, t0: 0, tau: 0, t: 0}  # fmt: skip
    assert refute(claim.goal(), values).verdict is Verdict.UNDECIDED
