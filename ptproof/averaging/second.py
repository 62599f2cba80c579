"""Averages of systems with powers of the frequency: γ_ij(ω), γ_ijm(ω), nested brackets, and what is left as ω → ∞."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import sympy as sp

from ptproof.averaging.brackets import SparseField, Vector, sparse_bracket, tidy
from ptproof.averaging.coefficients import Coefficients, signals, tidy_constant, triple_means, v_matrix
from ptproof.averaging.exponents import Gamma, Point, told
from ptproof.averaging.powers import PoweredSystem
from ptproof.averaging.refusal import AveragingRefused, AveragingUndecided, check_form
from ptproof.averaging.words import Word, Words, frequencies_of, letters_of, long_words, word_of
from ptproof.proof.claim import Goal
from ptproof.proof.engines.exact import exact
from ptproof.proof.settling import settle
from ptproof.proof.signs import vanishes
from ptproof.proof.statement import Relation
from ptproof.proof.verdict import Verdict
from ptproof.system import System

Letters = tuple[int, ...]
_FACTORED = 24  # second derivatives of several unknown functions make many generators


@dataclass(frozen=True)
class PoweredAverage:
    """A system with powers, its coefficients, the brackets that are left as ω → ∞, and the averaged system.

    ``gammas``: {(i, j): γ_ij} and {(i, j, m): γ_ijm} for i < j. ``brackets``: those whose coefficient is left.
    ``account``: one sentence on each group of brackets that may count, and why it does or does not.

    Guaranteed: X = x + Σ_n ω^(Σ n_i (p_i − 1)) W_n(t, ωt, x), over words of up to N dithers with N (1 − p_i) > 1 for
    all i, obeys the averaged system but for terms that tend to 0 uniformly on compact sets, where the fields are C^N
    and the drift is C^1. So on every finite interval solutions tend to those of the average.
    """

    dithered: PoweredSystem
    system: System
    v: Coefficients
    gammas: Mapping[Letters, Gamma]
    brackets: Mapping[Letters, Vector] = field(repr=False)
    account: tuple[str, ...] = ()


def derive_powered(system: PoweredSystem, order: int = 2) -> PoweredAverage:
    """The average f₀ + lim Σ_{i<j} γ_ij [f_i, f_j] + lim Σ_{i<j} Σ_m γ_ijm [[f_i, f_j], f_m], for all allowed powers.

    Parameters
    ----------
    system
        Fields may be unknown; so may powers, as far as the limit is the same for all their allowed values.
    order
        2, or 1 for an average of brackets of two fields.

    Raises
    ------
    AveragingRefused
        If form, period or mean are not as they should be; or, named "limit", where a coefficient grows without bound
        and its bracket does not vanish, where the limit depends on the powers, or longer brackets count.
    AveragingUndecided
        If a dither is outside the class that is integrated exactly, or one of these is not known.

    Examples
    --------
    >>> from ptproof.averaging.powers import with_powers
    >>> from ptproof.averaging.problem import OMEGA, PHASE, TIME
    >>> from ptproof.system import DitherSystem
    >>> x, F = sp.Symbol("x", real=True), sp.Function("F", real=True)(sp.Symbol("x", real=True))
    >>> plain = DitherSystem(TIME, PHASE, OMEGA, (x,), (0,), ((1,), (F,)), (sp.cos(PHASE), sp.cos(2 * PHASE)))
    >>> found = derive_powered(with_powers(plain, [sp.Rational(2, 3)] * 2))
    >>> found.system.rhs, found.gammas[1, 2].condition
    ((-Derivative(F(x), (x, 2))/8,), 'it vanishes for every omega')
    """
    check_powered_form(system)
    own = _Derivation(system)
    gammas = own.gammas()
    groups = own.groups()
    account: list[str] = []
    total: list[list[sp.Expr]] = [[] for _ in system.state]
    for group in groups:
        account.append(own.judged(group, order))
        if group.signs.keys() == {0}:
            for row, entry in enumerate(group.total):
                total[row].append(entry)
    left = {
        letters: own.bracket(letters) for letters, gamma in gammas.items() if gamma.limit is not None and gamma.limit
    }
    own.compare(gammas, left, total)
    rhs = tuple(
        start + tidy(sp.Add(*entries), _FACTORED) if entries else start
        for start, entries in zip(system.plain.drift, total, strict=True)
    )
    averaged = System(system.plain.time, system.state, rhs, name=f"average of {system.name}")
    shown = {letters: value.vector for letters, value in left.items() if value.entries}
    return PoweredAverage(system, averaged, own.v, gammas, shown, tuple(account))


def check_powered_form(system: PoweredSystem) -> None:
    """As :func:`ptproof.averaging.refusal.check_form`; a dither depends on the phase alone."""
    plain = system.plain
    check_form(plain, "the amplitude omega^power")
    for i, dither in enumerate(plain.dithers, start=1):
        if plain.time in dither.free_symbols:
            reason = f"it depends on the time {plain.time}; put that into its field"
            raise AveragingRefused("form", f"dither {i}", reason)


@dataclass(frozen=True)
class _Group:
    """Words with one exponent, and the sum of their brackets with their coefficients."""

    exponent: sp.Expr
    words: tuple[Word, ...]
    total: Vector
    signs: Mapping[int, Point]

    def __str__(self) -> str:
        return " and ".join(f"dithers {', '.join(map(str, letters_of(word)))}" for word in self.words)


class _Derivation:
    """What is worked out once for one system."""

    def __init__(self, system: PoweredSystem) -> None:
        plain = self.plain = system.plain
        self.count = len(system.powers)
        self.found = signals(plain)
        self.v = v_matrix(plain)
        self.words = Words(system.powers, frequencies_of(self.found), system.exponents)
        self.fields = [SparseField(entries, plain.state) for entries in plain.fields]
        self._mean = triple_means(self.found)
        self._starts = [signal.primitive.pieces[0].at(sp.S.Zero) for signal in self.found]
        self._brackets: dict[Letters, SparseField] = {}

    def bracket(self, letters: Letters) -> SparseField:
        """[f_i, f_j] or [[f_i, f_j], f_m]."""
        if letters not in self._brackets:
            *before, last = letters
            first = self.fields[before[0] - 1] if len(before) == 1 else self.bracket(tuple(before))
            self._brackets[letters] = sparse_bracket(first, self.fields[last - 1], _FACTORED)
        return self._brackets[letters]

    def gammas(self) -> dict[Letters, Gamma]:
        """All γ_ij and γ_ijm with i < j."""
        result: dict[Letters, Gamma] = {}
        for i, j in itertools.combinations(range(1, self.count + 1), 2):
            result[i, j] = self._gamma((i, j), self.v[j, i])
            for m in range(1, self.count + 1):
                result[i, j, m] = self._gamma((i, j, m), self._from_zero(i, j, m))
        return result

    def _gamma(self, letters: Letters, mean: sp.Expr) -> Gamma:
        exponent = self.words.exponent(word_of(letters, self.count))
        return Gamma(mean, exponent, self.words.allowed.signs(exponent))

    def _centred(self, i: int, j: int, m: int) -> sp.Expr:
        """The mean of γ_ijm, with the antiderivatives of zero mean."""
        return (self._mean(i - 1, j - 1, m - 1) - self._mean(j - 1, i - 1, m - 1)) / 3

    def _from_zero(self, i: int, j: int, m: int) -> sp.Expr:
        """The mean of γ_ijm, with the antiderivatives that vanish at 0."""
        c_i, c_j, c_m = (-self._starts[letter - 1] for letter in (i, j, m))
        shift = c_i * self._pair(j, m) + c_m * self._pair(j, i) - c_j * self._pair(i, m) - c_m * self._pair(i, j)
        return tidy_constant(sp.expand(self._centred(i, j, m) - shift / 3))

    def _pair(self, outer: int, inner: int) -> sp.Expr:
        """The mean of u_outer times the antiderivative of u_inner."""
        if outer == inner:
            return sp.S.Zero
        return self.v[outer, inner] if outer > inner else -self.v[inner, outer]

    def groups(self) -> list[_Group]:
        """The words that may count, those of one exponent together."""
        try:
            words = self.words.counting()
        except AveragingUndecided:
            # A short one that grows is reason enough.
            for group in self._grouped([word for word in self.words.short() if self.words.resonates(word)]):
                self.judged(group, 2)
            raise
        return self._grouped(words)

    def _grouped(self, words: Sequence[Word]) -> list[_Group]:
        totals = {word: self._total(word) for word in words if sum(word) <= 3}
        totals |= long_words(self.plain, [word for word in words if sum(word) > 3])
        result: list[tuple[sp.Expr, list[Word]]] = []
        for word in words:
            exponent = self.words.exponent(word)
            same = (entry for entry in result if self.words.allowed.equal(entry[0], exponent))
            entry = next(same, None)
            if entry is None:
                result.append((exponent, [word]))
            else:
                entry[1].append(word)
        return [
            _Group(
                exponent,
                tuple(group),
                tuple(sp.Add(*row) for row in zip(*(totals[word] for word in group), strict=True)),
                self.words.allowed.signs(exponent),
            )
            for exponent, group in result
        ]

    def _total(self, word: Word) -> Vector:
        """The sum of the brackets of a word of two or three letters, with their coefficients."""
        rows: list[list[sp.Expr]] = [[] for _ in self.plain.state]
        for i, j in itertools.combinations(sorted(set(letters_of(word))), 2):
            rest = tuple(n - (letter in (i, j)) for letter, n in enumerate(word, start=1))
            if min(rest) < 0:
                continue
            letters = (i, j, *letters_of(rest))
            value = self._centred(*letters) if len(letters) == 3 else self.v[j, i]
            value = tidy_constant(sp.expand(value))
            if value != 0:
                for row, entry in self.bracket(letters).entries.items():
                    rows[row].append(value * entry)
        return tuple(tidy(sp.Add(*entries), _FACTORED) if entries else sp.S.Zero for entries in rows)

    def judged(self, group: _Group, order: int) -> str:
        """Why a group does not stand in the way of the limit, in a sentence.

        Raises
        ------
        AveragingRefused, AveragingUndecided
            If it does, or if that is not known.
        """
        power = f"omega**({group.exponent})"
        if all(vanishes(entry) for entry in group.total):
            return f"{group}: the brackets with {power} add up to 0"
        if group.signs.keys() == {0}:
            if max(map(sum, group.words)) > order + 1:
                longest = max(map(sum, group.words))
                told_order = "set order = 2" if longest == 3 else "the average of second order has none such"
                raise AveragingRefused("limit", str(group), f"brackets of {longest} fields count; {told_order}")
            return f"{group}: these brackets count, with omega**0"
        if (where := self._not_zero(group.total)) is None:
            raise AveragingUndecided(f"limit: {group}: whether the brackets with {power} vanish is not known")
        if 1 in group.signs:
            there = f" for {told(group.signs[1])}" if group.signs[1] else ""
            raise AveragingRefused(
                "limit",
                str(group),
                f"the average has {power} times brackets that do not vanish ({where}), which grows without bound "
                f"as omega does{there}; there is no limit",
            )
        raise AveragingRefused(
            "limit",
            str(group),
            f"the average has {power} times brackets that do not vanish ({where}), which is left for "
            f"{told(group.signs[0])} and tends to 0 for {told(group.signs[-1])}; add the condition "
            f"{group.exponent} < 0, or = 0",
        )

    def _not_zero(self, total: Vector) -> str | None:
        """Where a vector certainly does not vanish, in words; None where that is not known."""
        goal = Goal("brackets", Relation(sp.Matrix(total), "=", sp.zeros(len(total), 1)), where_defined=True)
        evidence = settle(goal, exact)
        if evidence.verdict is not Verdict.REFUTED or evidence.witness is None:
            return None
        values = ", ".join(f"{name} = {value}" for name, value in evidence.witness.values.items())
        return f"{evidence.witness.left} at {values}" if values else f"{evidence.witness.left}"

    def compare(
        self, gammas: Mapping[Letters, Gamma], left: Mapping[Letters, SparseField], total: list[list[sp.Expr]]
    ) -> None:
        """The sum by the coefficients from 0 on, as they are defined, must be the one by centred antiderivatives."""
        for row, entries in enumerate(total):
            terms = [gammas[letters].mean * value.vector[row] for letters, value in left.items()]
            if not vanishes(sp.Add(*terms, *(-entry for entry in entries))):
                raise AveragingUndecided("limit: two ways to the average are not shown to agree")
