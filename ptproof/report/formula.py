"""Formulas: a statement as lines of LaTeX in the paper's letters, and LaTeX as MathML."""

from __future__ import annotations

import html
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass
from functools import lru_cache
from typing import Any
from xml.etree import ElementTree

import sympy as sp

from ptproof.proof.statement import (
    All,
    Assumption,
    Exists,
    ForAll,
    Prose,
    Relation,
    Runs,
    Smooth,
    Statement,
    free_symbols,
    undefined_functions,
)
from ptproof.report.printer import Names as Names
from ptproof.report.printer import latex as latex
from ptproof.report.printer import ordered

SIGNS = {"=": "=", "<=": r"\le", "<": "<", ">=": r"\ge", ">": ">", "!=": r"\ne"}
_ROOM = 84.0  # characters in a line of the page
_LONG = 250  # characters of LaTeX that are seldom a line
_BRACKETS, _APART = 2.0, 1.0  # the width of a matrix's brackets, and of what is between two columns
_FUNCTIONS = frozenset(
    ["sin", "cos", "tan", "log", "ln", "exp", "sinh", "cosh", "tanh", "atan", "asin", "acos", "arctan", "lim", "sign"]
)


@dataclass(frozen=True)
class Line:
    """One line of a displayed formula, as LaTeX; what continues a broken line is indented, in steps."""

    latex: str
    indent: int = 0


def statement_lines(statement: Statement | Assumption, names: Names) -> tuple[Line, ...]:
    """The statement line by line; a long relation is broken before its sign and between the terms of a sum."""
    match statement:
        case Relation():
            return _relation_lines(statement, names)
        case All(parts):
            return tuple(line for part in parts for line in _relation_lines(part, names))
        case Exists(variables=variables, body=body, over=over):
            head = rf"\exists\, {_typed(variables, names)}"
            if over:
                head += rf"\ \ \forall\, {_typed(over, names)}"
            inside = (line for part in body for line in _relation_lines(part, names))
            return (Line(head + ":"), *(Line(line.latex, line.indent + 1) for line in inside))
        case Smooth(expressions=expressions, variables=variables, order=order):
            column = expressions[0] if len(expressions) == 1 else sp.ImmutableDenseMatrix(list(expressions))
            belongs = rf"{latex(column, names)} \in C^{{{order}}}"
            return (Line(belongs + rf"\quad \text{{in}}\ {_list(variables, names)}"),)
        case ForAll(variables=variables, relation=relation, domain=domain):
            lines = _relation_lines(relation, names)
            where = r",\ ".join(line.latex for part in domain for line in _relation_lines(part, names))
            tail = rf"\forall\, {_list(variables, names)}" + (rf":\ {where}" if domain else "")
            if sum(width(line.latex) for line in lines) + width(tail) < _ROOM and len(lines) == 1:
                return (Line(rf"{lines[0].latex} \quad {tail}"),)
            return (*lines, Line(tail, 1))
        case Runs():
            return tuple(_runs_lines(statement, names))
        case Prose():
            return ()
    return (Line(str(statement.latex(symbol_names=dict(names)))),)  # a kind of statement that is newer than this page


def _runs_lines(said: Runs, names: Names) -> Iterator[Line]:
    time, (first, last) = latex(said.time, names), said.during
    for x, rate in zip(said.state, said.rates, strict=True):
        yield from _relation_lines(Relation(sp.Derivative(x, said.time), "=", rate), names)
    during = f"= {latex(last, names)}" if said.at_once else rf"\in [{latex(first, names)}, {latex(last, names)}]"
    for when, parts in (
        (rf"\text{{where, at}}\ {time} = {latex(said.span[0], names)}:", said.starts),
        (rf"\text{{exists until}}\ {latex(said.span[1], names)}\text{{, and at}}\ {time} {during}:", said.parts),
    ):  # fmt: skip
        yield Line(when)
        yield from (Line(line.latex, line.indent + 1) for part in parts for line in _relation_lines(part, names))


def domain_of(
    statements: Sequence[Statement | Assumption], bound: Iterable[sp.Symbol], names: Names
) -> tuple[str, ...]:
    """What the symbols and functions of the statements stand for, as LaTeX: ``k, T > 0`` and the like."""
    symbols = free_symbols(statements) - set(bound)
    order = {symbol: place for place, symbol in enumerate(names)}
    found = _groups(sorted(symbols, key=lambda item: (order.get(item, len(order)), sp.default_sort_key(item))), names)
    functions = {sp.Symbol(applied.func.__name__) for applied in undefined_functions(statements)}
    if functions:
        listed = _list(sorted(functions, key=lambda symbol: symbol.name), names)
        found.append(rf"{listed}\ \text{{arbitrary function{'s' if len(functions) > 1 else ''}}}")
    return tuple(found)


def _groups(symbols: Iterable[sp.Symbol], names: Names) -> list[str]:
    groups: dict[str, list[str]] = {}
    for symbol in symbols:
        groups.setdefault(_kind(symbol), []).append(latex(symbol, names))
    return [", ".join(letters) + kind for kind, letters in groups.items()]


def _typed(symbols: Iterable[sp.Symbol], names: Names) -> str:
    return r",\ ".join(_groups(symbols, names))


def _kind(symbol: sp.Symbol) -> str:
    if symbol.is_integer:
        return r" \in " + (
            r"\mathbb{N}" if symbol.is_positive else r"\mathbb{N}_0" if symbol.is_nonnegative else r"\mathbb{Z}"
        )
    if symbol.is_positive:
        return " > 0"
    if symbol.is_nonnegative:
        return r" \ge 0"
    if symbol.is_negative:
        return " < 0"
    return r" \in \mathbb{R}" if symbol.is_real else r" \in \mathbb{C}"


def _list(symbols: Iterable[sp.Symbol], names: Names) -> str:
    return ", ".join(latex(symbol, names) for symbol in symbols)


def _relation_lines(relation: Relation, names: Names) -> tuple[Line, ...]:
    left, right = latex(relation.left, names), latex(relation.right, names)
    sign = SIGNS[relation.sign]
    whole = f"{left} {sign} {right}"
    # What is likely to be shown is measured: the whole where it is short, the sides where it is long, and of a long
    # sum or matrix its terms or entries.
    if len(whole) > _LONG:
        wide = _wide(relation.left, left, names) + _wide(relation.right, right, names)
    else:
        wide = width(whole) - width(sign)
    if wide < _ROOM:
        return (Line(whole),)
    if isinstance(relation.left, sp.MatrixBase):
        return tuple(line for part in relation.components() for line in _relation_lines(part, names))
    first, *rest = _broken(relation.left, left, names)
    second, *more = _broken(relation.right, right, names)
    return (
        Line(first),
        *(Line(part, 2) for part in rest),
        Line(f"{sign} {second}", 1),
        *(Line(part, 2) for part in more),
    )


def _broken(expression: Any, whole: str, names: Names) -> list[str]:
    """A sum that is too wide for a line, between its terms."""
    if not isinstance(expression, sp.Add) or _wide(expression, whole, names) < _ROOM:
        return [whole]
    lines, wide = [""], 0.0
    for term in _terms(expression, names):
        wide += width(term)  # the terms of a line are as wide as the line
        if lines[-1] and wide > _ROOM:
            lines.append(term)
            wide = width(term)
        else:
            lines[-1] = f"{lines[-1]} {term}".strip()
    return lines


def _wide(expression: Any, whole: str, names: Names) -> float:
    """How wide the expression is, which is printed as ``whole``."""
    if len(whole) > _LONG:
        match expression:
            case sp.Add():
                return sum(map(width, _terms(expression, names)))
            case sp.MatrixBase():
                entries = ([_wide(entry, latex(entry, names), names) for entry in row] for row in expression.tolist())
                return _BRACKETS + sum(max(column) + _APART for column in zip(*entries, strict=True))
    return width(whole)


def _terms(expression: sp.Add, names: Names) -> list[str]:
    """The terms of a sum in their order, each but the first with its sign."""
    first, *rest = (latex(term, names) for term in ordered(expression.as_ordered_terms()))
    return [first, *(f"- {text[1:].lstrip()}" if text.startswith("-") else f"+ {text}" for text in rest)]


def mathml(source: str, *, display: bool = False) -> str:
    """MathML for LaTeX; LaTeX that the converter does not know is shown as it is, in a ``code`` element."""
    return markup(element(source, display=display), source)


def markup(found: ElementTree.Element | None, source: str) -> str:
    """A formula's element as text; without one, its LaTeX."""
    if found is None:
        return f"<code>{html.escape(source)}</code>"
    return ElementTree.tostring(found, encoding="unicode")


def element(source: str, *, display: bool = False) -> ElementTree.Element | None:
    """The formula as an element of its own, which may be changed; None where the converter does not know its LaTeX."""
    found = deepcopy(_converted(source))
    if found is not None:
        found.set("display", "block" if display else "inline")
    return found


@lru_cache(maxsize=8192)
def width(source: str) -> float:
    """About how many characters wide the formula is."""
    found = _converted(source)
    return float(len(source)) if found is None else _width(found)


_known: dict[str, ElementTree.Element | None] = {}
_MOST = 8192  # formulas that are kept


def converted(sources: Iterable[str]) -> dict[str, ElementTree.Element | None]:
    """The formulas, for another process that :func:`knows` them then."""
    return {source: _converted(source) for source in sources}


def knows(formulas: Mapping[str, ElementTree.Element | None]) -> None:
    """Take over formulas that were :func:`converted` in another process."""
    _known.update(formulas)


def _converted(source: str) -> ElementTree.Element | None:
    """The formula, which is shared: nobody changes it; None where the converter does not know its LaTeX."""
    if source not in _known:
        if len(_known) >= _MOST:
            _known.clear()
        _known[source] = _conversion(source)
    return _known[source]


def _conversion(source: str) -> ElementTree.Element | None:
    from latex2mathml.converter import Converter

    try:
        found = Converter().convert_to_element(source)
    except Exception:  # the converter raises many kinds; the formula is then shown as its LaTeX
        return None
    del found.attrib["xmlns"]
    for node in found.iter():
        if node.text:
            node.text = html.unescape(node.text)
    for parent in list(found.iter()):
        _repair(parent)
    return found


def _repair(parent: ElementTree.Element) -> None:
    """Limits go below ``lim``, and a function's name keeps a thin space from what stands before it."""
    if parent.tag == "msub" and len(parent) and parent[0].text == "lim":
        parent.tag = "munder"
    if parent.tag not in ("mrow", "math", "mtd", "msqrt"):
        return
    place = 1
    while place < len(parent):
        node, before = parent[place], parent[place - 1]
        head = node[0] if node.tag in ("msup", "msub", "munder") and len(node) else node
        if (head.text or "") in _FUNCTIONS and before.tag not in ("mo", "mspace"):
            parent.insert(place, ElementTree.Element("mspace", {"width": "0.1667em"}))
            place += 1
        place += 1


def _width(node: ElementTree.Element) -> float:
    match node.tag:
        case "mfrac" | "munder" | "mover" | "munderover" if len(node):
            return max(_width(child) for child in node)
        case "msup" | "msub" if len(node) == 2:
            return _width(node[0]) + 0.7 * _width(node[1])
        case "msubsup" if len(node) == 3:
            return _width(node[0]) + 0.7 * max(_width(node[1]), _width(node[2]))
        case "mtable":
            columns = zip(*([_width(cell) for cell in row] for row in node), strict=False)
            return sum(max(column) + _APART for column in columns)
        case "mspace":
            return 2 * float(re.sub(r"[^\d.]", "", node.get("width", "")) or 0)
    own = len(node.text or "") * (1.8 if node.tag == "mo" and node.text in ("=", "+", "−", "≤", "≥", "<", ">") else 1)
    return own + sum(_width(child) for child in node)
