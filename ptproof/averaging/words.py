"""Which brackets may count as ω → ∞: words of dithers that resonate and whose power of ω is not negative.

A bracket of n fields, of which n_i are f_i, comes with ω^E, E = Σ n_i p_i − (n − 1) = 1 − Σ n_i (1 − p_i). Since each
p_i is less than 1, E falls with every field that is added, also with the drift. The coefficient of a word is a mean of
products of the dithers and their antiderivatives of zero mean; it vanishes where no sum of the frequencies, one with
either sign for each letter, is 0.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import sympy as sp

from ptproof.averaging.brackets import Vector
from ptproof.averaging.expansion import normal_form
from ptproof.averaging.exponents import Exponents
from ptproof.averaging.oscillation import Oscillation
from ptproof.averaging.refusal import AveragingUndecided
from ptproof.averaging.signal import Signal
from ptproof.proof.statement import Relation
from ptproof.system import DitherSystem

Word = tuple[int, ...]
_LONGEST = 10
_MOST = 1000


@dataclass(frozen=True)
class Words:
    """The dithers as far as words of them are concerned: powers, and the frequencies in turns per common period.

    ``frequencies`` has the whole numbers that occur in each dither, or None where it is no sum of sines and cosines.
    """

    powers: tuple[sp.Expr, ...]
    frequencies: tuple[frozenset[int] | None, ...]
    allowed: Exponents

    def exponent(self, word: Word) -> sp.Expr:
        """E of a word, given as the counts n_i."""
        return sp.expand(1 - sp.Add(*(count * (1 - power) for count, power in zip(word, self.powers, strict=True))))

    def may_count(self, word: Word) -> bool:
        """Whether E is not negative for some allowed values."""
        return self.allowed.point(Relation(sp.S.Zero, "<=", self.exponent(word))) is not None

    def resonates(self, word: Word, beside: int = 0) -> bool:
        """Whether some sum of the frequencies, one for each letter, is 0 modulo ``beside``: False is certain."""
        sums = {0}
        for letter, count in enumerate(word):
            own = self.frequencies[letter]
            if own is None and count:
                return True
            for _ in range(count):
                sums = {s + sign * rate for s in sums for rate in own or () for sign in (1, -1)}
                sums = {s % beside for s in sums} if beside else sums
        return 0 in sums

    def counting(self) -> tuple[Word, ...]:
        """The words of two or more different letters that resonate and may count, shorter ones first.

        Raises
        ------
        AveragingUndecided
            If there is no end of them within sight.
        """
        count = len(self.powers)
        layer = [_word(count, pair) for pair in itertools.combinations(range(count), 2)]
        layer = [word for word in layer if self.may_count(word)]
        found: list[Word] = []
        seen = 0
        while layer:
            seen += len(layer)
            if sum(layer[0]) > _LONGEST or seen > _MOST:
                raise AveragingUndecided(
                    f"brackets of more than {min(_LONGEST, sum(layer[0]) - 1)} fields may count, where the powers come "
                    "near to 1; conditions that keep them away from 1 would help"
                )
            found += [word for word in layer if self.resonates(word)]
            longer: dict[Word, None] = {}
            for word in layer:
                longer |= dict.fromkeys(self._longer(word))
            layer = list(longer)
        return tuple(found)

    def short(self) -> tuple[Word, ...]:
        """The words of two and three letters, two of them different, that may count."""
        count = len(self.powers)
        pairs = [_word(count, pair) for pair in itertools.combinations(range(count), 2)]
        triples = dict.fromkeys(_added(pair, letter) for pair in pairs for letter in range(count))
        return tuple(word for word in (*pairs, *triples) if self.may_count(word))

    def _longer(self, word: Word) -> list[Word]:
        """The words with one letter more that may count; none where nothing that begins so resonates."""
        letters = [letter for letter in range(len(word)) if self.may_count(_added(word, letter))]
        steps = [self.frequencies[letter] for letter in letters]
        if letters and all(step is not None for step in steps):
            # What is added moves the sum by multiples of this.
            beside = math.gcd(*(rate for step in steps for rate in step or ()))
            fixed = tuple(0 if letter in letters else count for letter, count in enumerate(word))
            if not self.resonates(fixed, beside):
                return []
        return [_added(word, letter) for letter in letters]


def frequencies_of(found: Sequence[Signal]) -> tuple[frozenset[int] | None, ...]:
    """The whole numbers of turns per period that occur in each dither, or None for one with pieces."""
    result: list[frozenset[int] | None] = []
    for signal in found:
        if not signal.is_trigonometric:
            result.append(None)
            continue
        turns = (sp.radsimp(sp.simplify(rate * signal.period / (2 * sp.pi))) for _, rate in signal.pieces[0].terms)
        result.append(frozenset(int(turn) for turn in turns))
    return tuple(result)


def letters_of(word: Word) -> tuple[int, ...]:
    """The letters of a word, counted from 1: (2, 0, 1) is 1, 1, 3."""
    return tuple(letter for letter, count in enumerate(word, start=1) for _ in range(count))


def word_of(letters: Sequence[int], count: int) -> Word:
    """The word of these letters, counted from 1, among ``count``."""
    return _word(count, [letter - 1 for letter in letters])


def _word(count: int, letters: Sequence[int]) -> Word:
    return tuple(letters.count(letter) for letter in range(count))


def _added(word: Word, letter: int) -> Word:
    return tuple(count + (own == letter) for own, count in enumerate(word))


def long_words(system: DitherSystem, words: Sequence[Word]) -> dict[Word, Vector]:
    """The parts of the average of dx/dσ = δ Σ f_i u_i that belong to these words: at δ^n, of n letters.

    Each dither gets a factor of its own, λ_i, and the part of a word is what Π λ_i^(n_i) is multiplied by. The drift
    is left out: brackets with it do not count as ω → ∞.

    Raises
    ------
    AveragingUndecided
        If the fields or the dithers are outside the class that is expanded exactly.
    """
    result: dict[Word, Vector] = {}
    for word in words:
        used = sorted({letter - 1 for letter in letters_of(word)})
        marks = [sp.Symbol(f"lambda_{letter}_", real=True) for letter in used]
        rates = tuple(
            sp.Add(*(mark * system.fields[i][row] * system.dithers[i] for mark, i in zip(marks, used, strict=True)))
            for row in range(len(system.state))
        )
        length = sum(word)
        expansion = normal_form(Oscillation(system.phase, system.period, system.state, (rates,)), length)
        counts = {mark: word[i] for mark, i in zip(marks, used, strict=True)}
        result[word] = tuple(_coefficient(entry, counts) for entry in expansion.means[length - 1])
    return result


def _coefficient(entry: sp.Expr, counts: dict[sp.Symbol, int]) -> sp.Expr:
    expanded = sp.expand(entry)
    for mark, power in counts.items():
        expanded = expanded.coeff(mark, power)
    return expanded
