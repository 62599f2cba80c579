"""The averages to any order, word by word: which part of them comes from which dithers."""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from ptproof.averaging.brackets import Vector
from ptproof.averaging.expansion import normal_form
from ptproof.averaging.oscillation import Oscillation
from ptproof.averaging.words import Word, letters_of
from ptproof.system import DitherSystem


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
