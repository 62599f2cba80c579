"""Where a printed formula and its correction differ: the symbols that one has and the other has not are marked."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from difflib import SequenceMatcher
from typing import TypeAlias
from xml.etree.ElementTree import Element

from ptproof.report.formula import Line, element, markup

# Below this share of common symbols the marks would say nothing; in a long formula sooner than in one of a line or two.
_ALIKE, _ALIKE_IF_LONG, _LONG = 0.5, 0.7, 130
_PLACES = ("msup", "msub", "msubsup", "mfrac", "munder", "mover", "munderover", "mroot")

Leaf: TypeAlias = tuple[Element, tuple[object, ...]]


def marked(printed: Sequence[Line], corrected: Sequence[Line]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Both formulas as MathML, line by line, with what differs in the class ``differs``.

    Symbols are compared in the order in which they are read, each with its place (an exponent is no factor). Formulas
    that have little in common, and those that the converter does not know, are left as they are.
    """
    first, second = ([element(line.latex, display=True) for line in lines] for lines in (printed, corrected))
    if all(found is not None for found in (*first, *second)):
        _mark(list(_leaves(first)), list(_leaves(second)))
    return (
        tuple(markup(found, line.latex) for found, line in zip(first, printed, strict=True)),
        tuple(markup(found, line.latex) for found, line in zip(second, corrected, strict=True)),
    )


def _leaves(lines: Sequence[Element | None]) -> Iterator[Leaf]:
    for line in lines:
        if line is not None:
            yield from _inside(line, ())


def _inside(node: Element, place: tuple[object, ...]) -> Iterator[Leaf]:
    if not len(node):
        if (node.text or "").strip():
            yield node, (node.text, *place)
        return
    for number, child in enumerate(node):
        yield from _inside(child, (*place, node.tag, number) if node.tag in _PLACES else place)


def _mark(first: list[Leaf], second: list[Leaf]) -> None:
    matcher = SequenceMatcher(None, [key for _, key in first], [key for _, key in second], autojunk=False)
    if matcher.ratio() < (_ALIKE_IF_LONG if len(first) + len(second) > _LONG else _ALIKE):
        return
    for what, start, end, other_start, other_end in matcher.get_opcodes():
        if what != "equal":
            for node, _ in (*first[start:end], *second[other_start:other_end]):
                node.set("class", "differs")
