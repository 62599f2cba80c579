"""The quasi-steady state of the fast states, and whether it is the only one."""

from __future__ import annotations

import contextlib
from collections.abc import Sequence

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.averaging.brackets import Vector
from ptproof.averaging.problem import FastStates
from ptproof.averaging.samples import masked_functions, sample_points
from ptproof.errors import InputError
from ptproof.proof.algebra import NotAlgebraic
from ptproof.proof.engines.reals import follows
from ptproof.proof.engines.smoothness import smoothness
from ptproof.proof.signs import holds, sign_of, vanishes
from ptproof.proof.statement import Relation
from ptproof.proof.substitution import Substitution
from ptproof.proof.verdict import Evidence, Verdict, Witness
from ptproof.transforms import reduction

ENGINE = "quasi-steady state"
_SECONDS = 3.0


def quasi_steady_state(fast: FastStates, domain: Sequence[Relation] = ()) -> tuple[Vector | None, Evidence]:
    """Solve 0 = g(x, z) for z, or check the solution that the author gives (ass:singular_ass, F).

    Returns z = l(x), None where none is known, and what is known about its being ``unique``.

    Affine rates are solved by linear algebra; others one after the other where each has one new fast state, by
    the linear factors of the rate; the rest is left to SymPy's solver and checked. ``unique`` is proved where
    every other factor was shown not to vanish or g to be strictly monotone in z, and refuted with exact values
    at which g has no real zero or several.
    """

    def result(
        values: Sequence[sp.Expr] | None, verdict: Verdict, detail: str, witness: Witness | None = None
    ) -> tuple[Vector | None, Evidence]:
        return None if values is None else tuple(values), Evidence(ENGINE, verdict, detail, witness=witness)

    values = fast.quasi_steady_state
    if values is not None:
        there = dict(zip(fast.state, values, strict=True))
        for rest in (rate.subs(there, simultaneous=True) for rate in fast.rate):
            if not vanishes(rest):
                witness = _nonzero(rest, domain)
                detail = (
                    f"{list(values)} {'is not shown to' if witness is None else 'does not'} make the fast rates vanish"
                )
                return result(None, Verdict.UNDECIDED if witness is None else Verdict.REFUTED, detail, witness)
    if all(sp.expand(sp.diff(rate, a, b)) == 0 for rate in fast.rate for a in fast.state for b in fast.state):
        with contextlib.suppress(InputError):
            affine, shown = reduction.solve_quasi_steady_state(fast.rate, fast.state)
            if shown:
                return result(values or affine, Verdict.PROVED, "the rates are affine in the fast states, and regular")
    found, reason = _cascade(fast, domain)
    if found is not None:
        return result(values or found, Verdict.PROVED, reason)
    if (counted := _count(fast, domain)) is not None:
        detail, witness = counted
        return result(values, Verdict.REFUTED, detail, witness)
    if values is None:
        try:
            values, _ = reduction.solve_quasi_steady_state(fast.rate, fast.state, "the fast rates")
        except (InputError, NotAlgebraic) as error:
            return result(None, Verdict.UNDECIDED, str(error))
    if _monotone(fast, domain):
        return result(values, Verdict.PROVED, "the rates are strictly monotone in the fast states")
    return result(values, Verdict.UNDECIDED, f"z = {list(values)} is one solution; {reason}")


def _nonzero(rest: sp.Expr, domain: Sequence[Relation]) -> Witness | None:
    """Exact values in the region at which ``rest`` is certainly not 0."""
    masked, back = masked_functions(rest)
    for point in sample_points(masked.free_symbols, domain, back):
        value = masked.subs(point)
        if sign_of(value) in (-1, 1):
            names = {str(back.get(entry, entry)): str(number) for entry, number in point.items()}
            return Witness(names, str(value), "0")
    return None


def _cascade(fast: FastStates, domain: Sequence[Relation]) -> tuple[tuple[sp.Expr, ...] | None, str]:
    """Solve one rate after the other, each for its only unknown fast state."""
    known: dict[sp.Symbol, sp.Expr] = {}
    rates = list(fast.rate)
    while rates:
        for rate in rates:
            current = rate.subs(known, simultaneous=True)
            unknown = set(fast.state) & current.free_symbols - known.keys()
            if len(unknown) == 1:
                break
        else:
            return None, "no other solution was excluded"
        (symbol,) = unknown
        value = _only_root(current, symbol, domain) or _monotone_root(fast, current, symbol, domain)
        if value is None:
            return None, f"that it is the only zero of {rate} was not shown"
        known[symbol] = value
        rates.remove(rate)
    if set(known) != set(fast.state):
        return None, "the rates leave a fast state open"
    return tuple(known[symbol] for symbol in fast.state), (
        "each rate, one after the other, has one zero in its fast state: a linear factor, or it is strictly monotone"
    )


def _monotone_root(fast: FastStates, rate: sp.Expr, symbol: sp.Symbol, domain: Sequence[Relation]) -> sp.Expr | None:
    """The author's value (checked elsewhere to be a zero) if ``rate`` is strictly monotone in ``symbol``."""
    slope = sp.diff(rate, symbol)
    signs = Relation(slope, "<", sp.S.Zero), Relation(sp.S.Zero, "<", slope)
    if (
        fast.quasi_steady_state
        and _is_continuous(fast, domain)
        and any(follows(sign, domain, seconds=_SECONDS).shown for sign in signs)
    ):
        return fast.quasi_steady_state[fast.state.index(symbol)]
    return None


def _only_root(rate: sp.Expr, symbol: sp.Symbol, domain: Sequence[Relation]) -> sp.Expr | None:
    masked, back = masked_functions(rate)
    if any(symbol in node.free_symbols for node in back.values()):
        return None  # a function of the fast state itself
    roots, others = [], []
    for factor, _ in sp.factor_list(sp.fraction(sp.together(masked))[0])[1]:
        if symbol in factor.free_symbols and factor.is_polynomial(symbol) and sp.degree(factor, symbol) == 1:
            slope, rest = sp.Poly(factor, symbol).all_coeffs()
            roots.append(sp.cancel(-rest / slope))
            others.append(slope)
        else:
            others.append(factor)
    if len(roots) != 1:
        return None
    for other in others:
        if other.is_nonzero or follows(Relation(other, "!=", sp.S.Zero), domain, seconds=_SECONDS).shown:
            continue
        return None
    return roots[0].xreplace(back)


def _count(fast: FastStates, domain: Sequence[Relation]) -> tuple[str, Witness] | None:
    """Exact values of everything else at which a scalar polynomial rate has no zero in the region, or several."""
    if len(fast.state) != 1:
        return None
    (symbol,), (rate,) = fast.state, fast.rate
    masked, back = masked_functions(rate)
    if any(symbol in node.free_symbols for node in back.values()):
        return None  # a function of the fast state itself
    numerator, denominator = sp.fraction(sp.together(masked))
    if not numerator.is_polynomial(symbol):
        return None
    own = [relation for relation in domain if symbol in relation.free_symbols]
    for there in sample_points((numerator.free_symbols | denominator.free_symbols) - {symbol}, domain, back):
        polynomial, bottom = numerator.subs(there), denominator.subs(there)
        if symbol not in polynomial.free_symbols:
            continue
        roots = _roots_within(polynomial, bottom, symbol, list(map(Substitution(there).relation, own)))
        if roots is not None and len(roots) != 1:
            names = {str(back.get(entry, entry)): str(value) for entry, value in there.items()}
            where = f" with {', '.join(map(str, own))}" if own else ""
            if len(roots) == 0:
                return f"0 = {polynomial} has no real solution{where}", Witness(names, str(polynomial), "0")
            detail = f"0 = {polynomial} has {len(roots)} real solutions{where}: {', '.join(map(str, roots))}"
            return detail, Witness({**names, str(symbol): str(roots[0])}, str(roots[0]), str(roots[1]))
    return None


def _roots_within(
    polynomial: sp.Expr, bottom: sp.Expr, symbol: sp.Symbol, domain: Sequence[Relation]
) -> list[sp.Expr] | None:
    """The real roots at which the domain's relations hold, each once; None where something is not certain."""
    scalar = sp.Poly(polynomial, symbol)
    if not (scalar.domain.is_QQ or scalar.domain.is_ZZ):
        return None
    within = []
    for root in sorted(set(scalar.real_roots()), key=float):
        if sign_of(bottom.subs(symbol, root)) not in (-1, 1):
            return None
        here = list(map(Substitution({symbol: root}).relation, domain))
        if all(map(holds, here)):
            within.append(root)
        elif not any(holds(relation.negation()) for relation in here):
            return None
    return within


def _is_continuous(fast: FastStates, domain: Sequence[Relation]) -> bool:
    """Whether the rates are: a jump, whose derivative comes out as 0, may add a zero to one that is monotone."""
    smooth = {applied.func: sp.oo for rate in fast.rate for applied in rate.atoms(AppliedUndef)}
    for rate in fast.rate:
        variables = sorted((symbol for symbol in rate.free_symbols if symbol.is_real), key=lambda symbol: symbol.name)
        if smoothness(rate, variables, 0, smooth, domain).verdict is not Verdict.PROVED:
            return False
    return True


def _monotone(fast: FastStates, domain: Sequence[Relation]) -> bool:
    """Whether g is continuous, and the symmetric part of −∂g/∂z is positive definite by its leading minors."""
    if not _is_continuous(fast, domain):
        return False
    matrix = -sp.Matrix(list(fast.rate)).jacobian(list(fast.state))
    symmetric = (matrix + matrix.T) / 2
    return all(
        follows(Relation(sp.S.Zero, "<", symmetric[:size, :size].det()), domain, seconds=_SECONDS).shown
        for size in range(1, len(fast.state) + 1)
    )
