"""The hypotheses of second-order Lie bracket averaging, each with its own verdict, for all allowed powers.

They are those of C. Labar, E. Garone, M. Kinnaert and C. Ebenbauer, Automatica 106 (2019), as V. Todorovski and
M. Krstic state them (arXiv 2307.11923, Assumptions 1 and 2). The second integral of Assumption 2 is read with the
upper limit τ of its inner one, as in the coefficient that it is to keep bounded.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import replace

import sympy as sp

from ptproof.averaging.brackets import SparseField, Vector, sparse_bracket
from ptproof.averaging.exponents import told
from ptproof.averaging.ledger import Ledger, bounded_fields, judged, period_and_mean, smooth_fields, unread
from ptproof.averaging.powers import PoweredProblem
from ptproof.averaging.refusal import unless_refused
from ptproof.averaging.second import PoweredAverage, check_powered_form, derive_powered
from ptproof.proof.claim import Goal
from ptproof.proof.engines.exact import exact
from ptproof.proof.kinks import KINKS
from ptproof.proof.settling import settle
from ptproof.proof.signs import vanishes
from ptproof.proof.statement import Relation
from ptproof.proof.verdict import Evidence, Verdict

CONDITIONS = ("2.1", "2.2", "2.3")
_LIMIT = "limit"
_ORDERS = (3, 4, 6, 10, 20, 50, 100, 1000)


def examine_powered(problem: PoweredProblem) -> tuple[Ledger, PoweredAverage | None]:
    """Every hypothesis of the theorem, whether there is a limit, and the average if there is.

    ``form``; ``1.1`` smooth fields; ``1.2`` bounded dithers; ``1.3`` period and mean; ``2.1``, ``2.2``, ``2.3`` the
    conditions on two, three and four fields; ``bounded``, where fields depend on time; and ``limit``: that the average
    is the limit for all allowed powers, which is shown from the system itself and does not rest on ``2.1`` to ``2.3``.
    Where one of these is not shown, it needs more derivatives, and ``smooth`` says whether the fields have them.
    """
    plain = problem.plain
    entries = {
        "form": judged(_form, problem),
        "1.1": judged(smooth_fields, plain, 3),
        "1.2": judged(_bounded_dithers, problem),
        "1.3": judged(period_and_mean, plain),
    }
    if any(problem.system.plain.time in entry.free_symbols for entry in _entries(problem)):
        entries["bounded"] = judged(bounded_fields, plain)
    if any(entries[letter].verdict is not Verdict.PROVED for letter in ("form", "1.3")):
        return Ledger(entries, None), None
    derived: list[PoweredAverage] = []
    limit = unless_refused(_LIMIT, lambda: derived.append(derive_powered(problem.system, problem.order)), "")
    found = derived[0] if derived else None
    if found is not None:
        limit = replace(limit, detail=f"{'; '.join(found.account) or 'no bracket counts'}{_for(problem)}")
        entries["2.1"] = judged(_brackets, problem, found, 2)
        entries["2.2"] = judged(_brackets, problem, found, 3)
        entries["2.3"] = judged(_quadruples, problem)
        if any(entries[letter].verdict is not Verdict.PROVED for letter in CONDITIONS):
            entries["smooth"] = judged(_smooth_enough, problem)
    return Ledger({**entries, _LIMIT: limit}, None), found


def _smooth_enough(problem: PoweredProblem) -> Evidence:
    """Whether the fields are C^N with N/(N + 1) above all powers, which the limit needs: that many words count at most.

    Where powers come as near to 1 as one likes, no N serves all of them; without kinks what is C^1000 here is smooth.
    """
    system = problem.system

    def enough(order: int) -> bool:
        bound = sp.Rational(order, order + 1)
        return all(system.exponents.always(Relation(power, "<", bound)) for power in system.powers)

    order = next(filter(enough, _ORDERS), None)
    if order is not None:
        return smooth_fields(problem.plain, order)
    if any(entry.has(*KINKS) for entry in _entries(problem)):
        return Evidence(
            "smoothness", Verdict.UNDECIDED, "powers may be near to 1, and whether fields are smooth is open"
        )
    return smooth_fields(problem.plain, _ORDERS[-1])


def _for(problem: PoweredProblem) -> str:
    system = problem.system
    if not any(power.free_symbols for power in system.powers):
        return ""
    return f", for all powers with {', '.join(map(str, system.conditions)) or 'values between 0 and 1'}"


def _entries(problem: PoweredProblem) -> Iterator[sp.Expr]:
    yield from problem.system.plain.drift
    yield from itertools.chain.from_iterable(problem.system.plain.fields)


def _form(problem: PoweredProblem) -> Evidence:
    fine = "drift + sum of field * omega^power * dither"
    return unless_refused("form", lambda: check_powered_form(problem.system), fine)


def _bounded_dithers(problem: PoweredProblem) -> Evidence:
    detail = "piecewise smooth and periodic, so bounded; a bound beyond 1 counts as part of the field"
    return unread(problem.system.plain) or Evidence("dithers", Verdict.PROVED, detail)


def _brackets(problem: PoweredProblem, found: PoweredAverage, length: int) -> Evidence:
    """p_i + p_j > 1 only where [f_i, f_j] or its coefficient vanishes; of three, > 2 and [[f_i, f_j], f_m]."""
    system, count = problem.system, 0
    fields = [SparseField(entries, system.state) for entries in system.plain.fields]
    for letters, gamma in found.gammas.items():
        if len(letters) != length or 1 not in gamma.signs:
            continue
        count += 1
        if gamma.mean == 0:
            continue
        value = fields[letters[0] - 1]
        for letter in letters[1:]:
            value = sparse_bracket(value, fields[letter - 1], 24)
        evidence = _zero(value.vector)
        if evidence.verdict is not Verdict.PROVED:
            where = f" for {told(gamma.signs[1])}" if gamma.signs[1] else ""
            what = "is not shown to vanish" if evidence.verdict is Verdict.UNDECIDED else "does not vanish"
            detail = (
                f"dithers {', '.join(map(str, letters))}: their powers add up to more than {length - 1}{where}, "
                f"the coefficient has the factor {gamma.mean} and the bracket {what}"
            )
            return replace(evidence, engine="brackets", detail=detail)
    sums = f"powers of {length} dithers add up to more than {length - 1}"
    if not count:
        return Evidence("brackets", Verdict.PROVED, f"no {sums}")
    return Evidence(
        "brackets", Verdict.PROVED, f"where {sums} ({_cases(count)}), the coefficient or the bracket vanishes"
    )


def _zero(value: Vector) -> Evidence:
    """Whether a vector vanishes identically, with a point at which it does not."""
    if all(vanishes(entry) for entry in value):
        return Evidence("exact", Verdict.PROVED, "it vanishes")
    goal = Goal("derivative", Relation(sp.Matrix(value), "=", sp.zeros(len(value), 1)), where_defined=True)
    return settle(goal, exact)


def _quadruples(problem: PoweredProblem) -> Evidence:
    """p_i + p_j + p_m + p_q ≥ 3 only where the third derivative of f_i along f_j, f_m and f_q vanishes."""
    system, allowed = problem.system, problem.system.exponents
    fields = [SparseField(entries, system.state) for entries in system.plain.fields]
    count, open_ones = 0, []
    for word in itertools.combinations_with_replacement(range(len(fields)), 4):
        total = sp.Add(*(system.powers[letter] for letter in word))
        if (there := allowed.point(Relation(sp.Integer(3), "<=", total))) is None:
            continue
        count += 1
        for letters in dict.fromkeys(itertools.permutations(word)):
            value = fields[letters[0]]
            for letter in letters[1:]:
                value = value.along(fields[letter])
            evidence = _zero(value.vector)
            if evidence.verdict is Verdict.PROVED:
                continue
            names = ", ".join(str(letter + 1) for letter in letters)
            where = f" for {told(there)}" if there else ""
            detail = f"dithers {names}: their powers add up to 3 or more{where}, and the third derivative of field "
            detail += f"{letters[0] + 1} along the others"
            if evidence.verdict is Verdict.REFUTED:
                return replace(evidence, engine="derivatives", detail=f"{detail} does not vanish")
            open_ones.append(f"{detail} is not shown to vanish")
    if open_ones:
        return Evidence("derivatives", Verdict.UNDECIDED, open_ones[0])
    if not count:
        return Evidence("derivatives", Verdict.PROVED, "no powers of four dithers add up to 3")
    detail = f"where powers of four dithers add up to 3 or more ({_cases(count)}), the third derivatives vanish"
    return Evidence("derivatives", Verdict.PROVED, detail)


def _cases(count: int) -> str:
    return f"{count} case" if count == 1 else f"{count} cases"
