"""The labels of a paper's equations, read from its LaTeX source.

A scanner, not a TeX engine: comments, verbatim text and ``\\iffalse`` parts are dropped, abbreviations such as
``\\newcommand{\\be}{\\begin{equation}}`` are expanded, and then environments are followed on a stack.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from ptproof.reading.latex.source import expanded, without_comments

_DISPLAYS = frozenset({
    "equation", "align", "gather", "multline", "flalign", "alignat", "xalignat", "xxalignat", "eqnarray", "displaymath",
    "math", "dmath", "dseries", "IEEEeqnarray", "numcases", "subnumcases", "empheq",
})  # fmt: skip
# Inside these a label still belongs to the group of equations around it.
_TRANSPARENT = frozenset(["center", "minipage", "small", "footnotesize", "scriptsize"])
_TOKEN = re.compile(r"\\(begin|end|label)\s*(?:\[[^\]]*\]\s*)?\{([^{}]*)\}|\\[\\\[\]]")


def all_labels(source: str) -> tuple[str, ...]:
    """Every label of the paper, of whatever, in the order of the text, each once."""
    return tuple(dict.fromkeys(name for name, _ in _labels(source)))


def equation_labels(source: str) -> tuple[str, ...]:
    """The labels that stand in an equation, in the order of the text, each once.

    Labels in the environments equation, align, gather, multline, flalign, alignat, eqnarray, subequations and
    their like count, starred or not, also on a line inside them or inside a nested aligned or split. Labels of
    sections, figures, theorems and list items do not.
    """
    return tuple(dict.fromkeys(name for name, in_equation in _labels(source) if in_equation))


def _labels(source: str) -> Iterator[tuple[str, bool]]:
    """Each label, and whether it stands in an equation."""
    stack: list[str] = []
    for token in _TOKEN.finditer(expanded(without_comments(source))):
        word, name = token.group(1), (token.group(2) or "").strip()
        if token.group() == r"\[":
            stack.append("displaymath")
        elif word == "begin":
            if name == "document":
                stack.clear()
            stack.append(name)
        elif token.group() == r"\]" or word == "end":
            name = name or "displaymath"
            if name == "document":
                break
            if name in stack:  # an end without its begin is ignored; a begin without its end closes with its parent
                del stack[len(stack) - 1 - stack[::-1].index(name) :]
        elif word == "label":
            yield name, _in_equation(stack)


def _in_equation(stack: list[str]) -> bool:
    """Whether a label here belongs to an equation: in a display, or in subequations and in nothing else there."""
    names = [name.rstrip("*") for name in stack]
    if any(name in _DISPLAYS for name in names):
        return True
    for name in reversed(names):
        if name == "subequations":
            return True
        if name not in _TRANSPARENT:
            return False
    return False
