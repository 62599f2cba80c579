"""What a paper itself says of its letters alone: signs, and intervals in which they lie.

Only what plainly holds throughout is *taken*, as an assumption of the claims that use the letter. The rest is *left* to
the author: what stands in a sentence with a condition, a case, a quantifier or a conclusion, what is said of a letter
that moves or that an equation defines, since that is a result, what contradicts another remark on the same letter, a
value of it included, and of two bounds the tighter. A value is not taken: it holds where it stands. Of a natural number
it is taken that it is not negative.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

import sympy as sp

from ptproof.drafting.guess import Guess
from ptproof.drafting.names import unused
from ptproof.drafting.rates import Said
from ptproof.reading.latex.formulas import Formula
from ptproof.reading.latex.statements import Pair
from ptproof.reading.tables import split_list

_FLIPPED = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "=": "=", "!=": "!="}
_LOCAL = re.compile(
    r"\b(?:if|when|whenever|unless|suppos\w*|otherwise|else|cases?|exists?|some|such that|whether|assum(?:e|ing)|once"
    r"|until|as long as|provided|only|while|whereas|hence|thus|therefore|impl(?:y|ies)|conclu\w*|follows|yields?|not"
    r"|cannot|no|or|either|contra\w+|instead|sufficiently|requires?|needs?)\b",
    re.IGNORECASE,
)
_QUANTIFIED = re.compile(
    r"\bfor\s+(?:all|any|every|each)\b|\bfor\b[^,;:]*$|\b(?:so|that|then|gets?|obtains?|have|has|shows?|finds?)\W*$",
    re.IGNORECASE,
)
_LET = re.compile(r"\blet\b|\bconsider(?:ing)?\W*$", re.IGNORECASE)
_INTRODUCED = re.compile(r"\s*\$?\s*(?:be|denote)\b")
_REFUSED = re.compile(r"\\(?:text|forall|exists|mid|quad|qquad|begin|[{}])(?![a-zA-Z])|\\[{}]|\\(?:to|rightarrow)\b")
_SIGN = re.compile(r"<|>|\\(?:leqslant|geqslant|leq?|geq?|lt|gt|in)(?![a-zA-Z])")
_NATURAL = re.compile(r"\\in\s*(?:\\mathbb\s*\{\s*N\s*\}|\\mathbb\s+N|\\N)(?![a-zA-Z{])\s*(?:_\{?[^{}]*\}?)?\s*$")
_NAMED = re.compile(r"([A-Za-z][\w{}\\]*)\s*:=\s*([\[(][^\[\]()]*,[^\[\]()]*[\])])")


@dataclass(frozen=True)
class Stated:
    """A relation of a letter, on the left, to numbers and other letters; ``name`` is what notation.py calls it."""

    pair: Pair
    line: int
    text: str
    name: str = ""


@dataclass(frozen=True)
class Conditions:
    """What a paper says of its letters alone: what is taken, and what is left with the reason."""

    taken: tuple[Stated, ...] = ()
    left: tuple[tuple[Stated, str], ...] = ()

    def of(self, letters: Iterable[sp.Basic]) -> tuple[Stated, ...]:
        """What is taken of these letters, and of those by which they are bounded."""
        known = set(letters)
        while more := set().union(*(i.pair.right.free_symbols for i in self.taken if i.pair.left in known)) - known:
            known |= more
        return tuple(item for item in self.taken if item.pair.left in known)


def conditions(
    formulas: Sequence[Formula], displayed: Sequence[Said], said: Callable[[Formula], Said], guessed: Guess
) -> Conditions:
    """What formulas of running text, read by ``said``, and relations in ``displayed`` ones say of letters alone."""
    letters = [name for name, item in guessed.declared.items() if not item.function]
    sets = {match[1].replace(" ", ""): match[2] for item in formulas for match in _NAMED.finditer(item.text)}
    known = set(letters)
    found: list[tuple[Stated, str]] = []
    for formula in formulas:
        for part in _split(formula, sets):
            found += _conditions(said(part), formula, known, every=True)
    for item in displayed:
        found += _conditions(item, item.formula, known, every=False)
    pairs = [pair for item in displayed if item.reading for pair in item.reading.pairs]
    results = {str(pair.left): "an equation defines it" for pair in pairs if pair.sign == "=" and pair.left.is_Symbol}
    results |= dict.fromkeys(guessed.states, "it moves")
    for time in guessed.times:
        results.pop(time, None)
    return _sorted([(item, why or results.get(str(item.pair.left), "")) for item, why in found], known)


def _conditions(said: Said, formula: Formula, known: set[str], *, every: bool) -> Iterator[tuple[Stated, str]]:
    """Each condition with why it cannot be taken; ``every``: nothing if the formula says something else beside."""
    if said.reading is None or _REFUSED.search(formula.text):
        return
    turned = [_turned(pair, known) for pair in said.reading.pairs]
    if every and None in turned:
        return
    for pair in turned:
        if pair is not None and pair.sign != "!=":
            yield Stated(pair, formula.line, " ".join(formula.text.split())), _local(formula, pair)


def _local(formula: Formula, pair: Pair) -> str:
    before, behind = formula.around
    if pair.sign == "=":
        return "it is a value"
    if match := _LOCAL.search(before) or _QUANTIFIED.search(before) or _LOCAL.search(behind):
        return f"its sentence says “{' '.join(match[0].split()[:2])}”"
    introduced = r"\in" in formula.text or _INTRODUCED.match(behind)
    return "" if introduced or not _LET.search(before) else "it may be let so for a while"


def _turned(pair: Pair, known: set[str]) -> Pair | None:
    """The relation with its letter on the left, if it is one of a letter to a sum of letters and numbers."""
    for left, sign, right in ((pair.left, pair.sign, pair.right), (pair.right, _FLIPPED.get(pair.sign, ""), pair.left)):
        named = left.is_Symbol and left.name in known and left not in right.free_symbols
        if named and sign and _is_bound(right, known):
            return Pair(left, sign, right)
    return None


def _is_bound(side: sp.Expr, known: set[str]) -> bool:
    return all(
        (term.is_number and term.is_finite and term.is_real) or (term.is_Symbol and term.name in known)
        for term in sp.Add.make_args(side)
    )


def _split(formula: Formula, sets: dict[str, str]) -> Iterator[Formula]:
    """A formula for each letter of a list, its set written out."""
    text = _NATURAL.sub(lambda _: r"\ge 0", formula.text.strip().rstrip(".,;"))
    text = re.sub(r"(\\in)\s*[A-Za-z][\w{}\\]*\s*:=", r"\1 ", text)
    before, sign, behind = text, "", ""
    if len(signs := list(_SIGN.finditer(text))) == 1:
        before, sign, behind = text[: signs[0].start()], signs[0][0], text[signs[0].end() :]
        if sign == r"\in":
            behind = sets.get(behind.replace(" ", ""), behind)
    if not sign:
        yield formula
        return
    for name in split_list(before):
        yield replace(formula, text=f"{name} {sign} {behind.strip()}")


def _sorted(found: Sequence[tuple[Stated, str]], known: Iterable[str]) -> Conditions:
    """What is taken of each letter: the weaker of two numbers, one bound by letters; nothing where two contradict."""
    every: dict[Pair, tuple[Stated, str]] = {}
    for item, why in found:
        if item.pair not in every or (every[item.pair][1] and not why):
            every[item.pair] = (item, why)
    taken: list[Stated] = []
    left: list[tuple[Stated, str]] = []
    for item, why in every.values():
        others = [other for other, _ in every.values() if other.pair.left == item.pair.left]
        same = [other for other, no in every.values() if not no and other in others and _way(other) == _way(item)]
        why = why or next((f"line {other.line} says otherwise" for other in others if _excludes(item, other)), "")
        why = why or next((f"line {o.line} says less" for o in same if o != item and not _is_weakest(item, o)), "")
        if why and item.pair.sign != "=":
            left.append((item, why))
        elif not why:
            taken.append(item)
    return Conditions(_named(taken, known), tuple(left))


def _named(taken: Sequence[Stated], known: Iterable[str]) -> tuple[Stated, ...]:
    named: list[Stated] = []
    for item in taken:
        name = unused(f"{item.pair.left.name}_stated", [*(other.name for other in named), *known])
        named.append(replace(item, name=name))
    return tuple(named)


def _way(item: Stated) -> str:
    return item.pair.sign[0]


def _is_weakest(item: Stated, other: Stated) -> bool:
    """Whether the bound says no more than the other one, both to the same side; of letters nobody can tell."""
    gap = item.pair.right - other.pair.right
    if not gap.is_number:
        return False
    if gap == 0:
        return len(item.pair.sign) > 1
    return bool(gap < 0) == (_way(item) == ">")


def _excludes(item: Stated, other: Stated) -> bool:
    """Whether no number has both bounds."""
    gap = item.pair.right - other.pair.right
    return bool(gap.is_number and (_values(item, gap) & _values(other, sp.S.Zero)) == sp.S.EmptySet)


def _values(item: Stated, bound: sp.Expr) -> sp.Set:
    if item.pair.sign == "=":
        return sp.FiniteSet(bound)
    strict = len(item.pair.sign) == 1
    return sp.Interval(bound, sp.oo, strict) if _way(item) == ">" else sp.Interval(-sp.oo, bound, False, strict)
