"""What a formula says: chains of relations, with the conditions beside them and the names that braces give."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import sympy as sp

from ptproof.errors import InputError
from ptproof.reading.latex.cursor import OTHER_RELATIONS, RELATIONS
from ptproof.reading.latex.formulas import Formula
from ptproof.reading.latex.grammar import Grammar
from ptproof.reading.latex.notation import Notation
from ptproof.reading.latex.tokens import Macro, NotUnderstood, Token, argument, nesting, read, written

_FLAT = frozenset({"aligned", "split", "gathered", "alignedat", "multlined"})
_GO_ON = frozenset({"+", "-", "/", r"\cdot", r"\times", *RELATIONS})
_WORDS = frozenset({"and", "where", "for", "with", "if", "or"})


@dataclass(frozen=True)
class Pair:
    """Two neighbours of a chain, numbers both, with the relation between them; ``entry``: of two matrices."""

    left: sp.Expr
    sign: str
    right: sp.Expr
    entry: bool = field(default=False, compare=False)

    def __str__(self) -> str:
        return f"{self.left} {self.sign} {self.right}"


@dataclass(frozen=True)
class Reading:
    """What a formula says: the relations of its chains, entry by entry, and the conditions behind a quantifier.

    ``braces`` are what braces under parts of it say (a name, and the part), ``unread`` says why braces were not read.
    """

    pairs: tuple[Pair, ...]
    conditions: tuple[Pair, ...] = ()
    braces: tuple[Pair, ...] = ()
    unread: tuple[str, ...] = ()

    def __str__(self) -> str:
        return ", ".join(map(str, self.pairs))

    def map(self, change: Callable[[sp.Expr], sp.Expr]) -> Reading:
        """The same with every side changed."""

        def changed(pairs: tuple[Pair, ...]) -> tuple[Pair, ...]:
            return tuple(replace(pair, left=change(pair.left), right=change(pair.right)) for pair in pairs)

        parts = changed(self.pairs), changed(self.conditions), changed(self.braces)
        return Reading(*parts, self.unread)


def read_formula(formula: Formula, macros: Mapping[str, Macro], notation: Notation) -> Reading:
    """What the formula says in this notation.

    Raises
    ------
    NotUnderstood
        With the line and what was not understood there.
    """
    if formula.broken:
        raise NotUnderstood("bad LaTeX", formula.broken, formula.line)
    try:
        return read_tokens(read(formula.text, formula.line, macros), notation)
    except RecursionError:
        raise NotUnderstood("bad LaTeX", "the formula is nested too deeply", formula.line) from None
    except (InputError, TypeError, ValueError, sp.SympifyError) as error:
        raise NotUnderstood("grammar", f"no value: {error}", formula.line) from None


def read_tokens(tokens: Sequence[Token], notation: Notation) -> Reading:
    """What tokens say that are a formula; with ± they are two."""
    found = [_read(variant, notation) for variant in _signs(list(tokens))]
    parts = [tuple(dict.fromkeys(item for each in found for item in getattr(each, name))) for name in _FIELDS]
    return Reading(*parts)


_FIELDS = ("pairs", "conditions", "braces", "unread")


def _signs(tokens: list[Token]) -> list[list[Token]]:
    """The formula with the upper and with the lower signs; an index 1, 2 is the first and the second of them."""
    if not any(token.text in (r"\pm", r"\mp") for token in tokens):
        return [tokens]
    variants: list[list[Token]] = [[], []]
    position = 0
    while position < len(tokens):
        token, ahead = tokens[position], [item.text for item in tokens[position : position + 6]]
        if token.text in (r"\pm", r"\mp"):
            signs = ("+", "-") if token.text == r"\pm" else ("-", "+")
            for variant, sign in zip(variants, signs, strict=True):
                variant.append(Token(sign, token.line))
        elif ahead[:2] == ["_", "{"] and ahead[3:4] == [","] and ahead[5:] == ["}"] and ahead[2] != ahead[4]:
            for variant, index in zip(variants, (ahead[2], ahead[4]), strict=True):
                variant += [token, tokens[position + 1], Token(index, token.line), tokens[position + 5]]
            position += 5
        else:
            for variant in variants:
                variant.append(token)
        position += 1
    return variants


def _read(tokens: list[Token], notation: Notation) -> Reading:
    pairs: list[Pair] = []
    conditions: list[Pair] = []
    braces: list[Pair] = []
    unread: list[str] = []
    listed: list[Any] = []
    line = tokens[0].line if tokens else 0
    for quantified, part in _parts(_flat(tokens)):
        grammar = Grammar(part, notation)
        found, alone = _chain(grammar, listed)
        listed = [] if found else [*listed, *alone]
        (conditions if quantified else pairs).extend(found)
        _name(grammar, notation, braces, unread)
        if quantified:
            listed = []
    if not pairs or listed:
        raise NotUnderstood("no relation", "the formula, or a part of it, is no relation", line)
    return Reading(tuple(pairs), tuple(conditions), tuple(braces), tuple(unread))


def _name(grammar: Grammar, notation: Notation, braces: list[Pair], unread: list[str]) -> None:
    """Read what stands under the braces, as an equation of the name and the part."""
    for below, above in grammar.braces:
        try:
            name = Grammar(below, notation)
            braces.extend(_entries(name.inner(below), "=", name.inner(above), below[0] if below else above[0]))
        except NotUnderstood as error:
            unread.append(f"the brace on line {error.line}: {error.reason}")
    grammar.braces = []


def _chain(grammar: Grammar, listed: Sequence[Any]) -> tuple[list[Pair], list[Any]]:
    """The relations of a chain, or what stands alone; what was listed before it is in the same set."""
    sides = [grammar.expression()]
    found: list[Pair] = []
    start = 0
    while grammar.text:
        token, end = grammar.take(), grammar.position - 1
        if token.text == r"\in":
            found += [Pair(*item) for item in grammar.membership([*listed, sides[-1]], token)]
            listed = []
            continue
        if token.text in OTHER_RELATIONS:
            raise grammar.refuse(
                "relation", f"{OTHER_RELATIONS[token.text]} ({token.text}) is no relation between numbers", token
            )
        if token.text not in RELATIONS:
            raise grammar.refuse("grammar", f"{token.text} is not expected here", token)
        sides.append(grammar.expression())
        if written(grammar.tokens[start:end]) == written(grammar.tokens[end + 1 : grammar.position]):
            raise grammar.refuse("no relation", "both sides are the same, letter for letter", token)
        start = end + 1
        found += _entries(sides[-2], RELATIONS[token.text], sides[-1], token)
    if found and listed:
        raise grammar.refuse("no relation", "a part of the formula is no relation")
    return found, sides


def _entries(left: Any, sign: str, right: Any, at: Token) -> list[Pair]:
    """The relation entry by entry; 0 is a column too."""
    if isinstance(left, sp.MatrixBase) and right == 0:
        right = sp.zeros(*left.shape)
    if isinstance(right, sp.MatrixBase) and left == 0:
        left = sp.zeros(*right.shape)
    if getattr(left, "shape", None) != getattr(right, "shape", None):
        raise NotUnderstood("matrix", "the two sides are of different shapes", at.line)
    if any(side.has(sp.nan, sp.zoo) for side in (left, right)):
        raise NotUnderstood("grammar", "a side has no value", at.line)
    if not isinstance(left, sp.MatrixBase):
        return [Pair(left, sign, right)]
    if sign != "=":
        raise NotUnderstood("matrix", "an inequality between matrices is not read", at.line)
    return [Pair(a, sign, b, True) for a, b in zip(left, right, strict=True)]


def _flat(tokens: list[Token]) -> list[Token]:
    """Rows that are one formula in one line: what lines them up is dropped, a break between two formulas is a comma."""
    result: list[Token] = []
    matrices = brackets = position = 0
    while position < len(tokens):
        token = tokens[position]
        position += 1
        text = token.text
        if text == r"\substack":
            group, position = argument(tokens, position, token)
            result += [token, Token("{", token.line), *group, Token("}", token.line)]
            continue
        name = text[text.index("{") + 1 : -1].rstrip("*") if text.startswith((r"\begin{", r"\end{")) else ""
        if name in _FLAT:
            if text.startswith(r"\begin") and position < len(tokens) and tokens[position].text == "[":
                position += 3
            continue
        if text.startswith((r"\begin{", r"\end{")):
            matrices += nesting(text)
        else:
            brackets += nesting(text)
        if matrices == 0 and text == "&":
            continue
        if matrices == 0 and text == "\\\\":
            following = next((t.text for t in tokens[position:] if t.text != "&"), "")
            last = result[-1].text if result else ""
            goes_on = last in {*_GO_ON, ","} or following in _GO_ON or following.startswith(r"\end")
            if brackets <= 0 and not goes_on:
                result.append(Token(",", token.line))
            continue
        result.append(token)
    return result


def _parts(tokens: list[Token]) -> Iterator[tuple[bool, list[Token]]]:
    """The relations of a formula that stand beside each other, and whether a quantifier opens each."""
    part: list[Token] = []
    depth = position = 0
    quantified = False
    for index, token in enumerate(tokens):
        if index < position:
            continue
        text = token.text
        depth += nesting(text)
        word = "".join(t.text for t in tokens[index + 2 : index + 8]).partition("}")[0] if text == r"\text" else ""
        if depth == 0 and (text in (",", ";", ".") or text == r"\forall" or word in _WORDS):
            if part:
                yield quantified, part
            part, quantified = [], text == r"\forall" or (quantified and text == ",")
            position = index + 1
            if word in _WORDS:
                position = index + 3 + len(word)
        else:
            part.append(token)
    if part:
        yield quantified, part
