"""The text of docstrings, which is Markdown with $formulas$, as HTML and as the Markdown of code hosts."""

from __future__ import annotations

import html
import re
from functools import cache
from textwrap import indent

from markdown_it import MarkdownIt
from markdown_it.tree import SyntaxTreeNode
from markupsafe import Markup
from mdit_py_plugins.dollarmath import dollarmath_plugin

from ptproof.report.formula import mathml

_ROLE = re.compile(r":[a-z]+:`~?(?:[^`]*\.)?([^`.]+)`")
_SPECIAL = re.compile(r"([\\`*_{}\[\]<>#|~$])")


@cache
def _parser() -> MarkdownIt:
    """Paragraphs, lists, `code` and $formulas$; stars and underscores belong to formulas in plain text (x*, a*b*c), and
    links, headings and HTML are the page's own affair."""
    return (
        MarkdownIt("zero").enable(["list", "newline", "backticks", "escape"]).use(dollarmath_plugin, allow_labels=False)
    )


def _tree(text: str) -> SyntaxTreeNode:
    return SyntaxTreeNode(_parser().parse(_ROLE.sub(r"`\1`", text)))


def to_html(text: str) -> str:
    """The text as HTML, everything in it escaped."""
    return _html(_tree(text))


def _html(node: SyntaxTreeNode) -> str:
    inside = [_html(child) for child in node.children]
    match node.type:
        case "root":
            return "\n".join(inside)
        case "bullet_list" | "ordered_list":
            return "\n".join([f"<{node.tag}>", *inside, f"</{node.tag}>"])
        case "list_item":
            return f"<li>{''.join(inside)}</li>"
        case "paragraph" if not node.hidden:
            return f"<p>{''.join(inside)}</p>"
        case "math_inline" | "math_block":
            return mathml(node.content.strip(), display=node.type == "math_block")
        case "code_inline":
            return f"<code>{html.escape(node.content)}</code>"
        case "softbreak" | "hardbreak":
            return " "
    return "".join(inside) or worded(node.content)


_INDEX = re.compile(r"(?<![\w:.])(\w*?[^\W\d_][\u0300-\u036f]?)_([A-Za-zα-ωϵ]{1,5}[₀-₉]*)(?![A-Za-z0-9_])")

# An exponent: a word, a sign, or what stands in parentheses, which may hold others.
_POWER = re.compile(
    r"\^(?:\(((?:[^()]|\((?:[^()]|\([^()]*\))*\))*)\)|([^\W_][^\W_\u0300-\u036f]*[\u0300-\u036f]?|[*∗]))"
)


def worded(text: str) -> Markup:
    """Text, escaped, with exponents set high and the index of a letter low: m^(2κ), ν_min, μT_f.

    Names such as file_name stay as they are.
    """

    def high(found: re.Match[str]) -> str:
        return f"<sup>{_POWER.sub(high, found[1] or found[2])}</sup>"

    def low(found: re.Match[str]) -> str:
        letters, index = found.groups()
        name = "_" in letters or (len(letters) > 3 and letters.isascii())
        return found[0] if name else f"{letters}<sub>{index}</sub>"

    return Markup(_INDEX.sub(low, _POWER.sub(high, html.escape(text))))


def to_markdown(text: str) -> str:
    """The text as Markdown in which nothing but lists, code and formulas means anything."""
    return _markdown(_tree(text))


def _markdown(node: SyntaxTreeNode) -> str:
    inside = [_markdown(child) for child in node.children]
    match node.type:
        case "root":
            return "\n\n".join(inside)
        case "bullet_list" | "ordered_list":
            return "\n".join(inside)
        case "list_item":
            mark = f"{node.info}{node.markup} " if node.info else "- "
            return mark + indent("\n\n".join(inside), " " * len(mark)).lstrip()
        case "math_inline":
            return inline_math(" ".join(node.content.split()))
        case "math_block":
            return display_math([node.content.strip()])
        case "code_inline":
            return code(node.content)
        case "softbreak" | "hardbreak":
            return " "
        case "text":
            # The spaces at its ends set it apart from what stands beside it.
            before, after = (" " if end.isspace() else "" for end in (node.content[:1], node.content[-1:]))
            return f"{before}{escape(node.content)}{after}"
    return "".join(inside)


def escape(text: str) -> str:
    """Text in which no character means anything to Markdown."""
    escaped = _SPECIAL.sub(r"\\\1", " ".join(text.split()))
    return re.sub(r"^(\d+)([.)])(?=\s)|^([-+])(?=\s)", lambda m: f"{m[1]}\\{m[2]}" if m[1] else f"\\{m[3]}", escaped)


def code(text: str, *, cell: bool = False) -> str:
    """Text as inline code, also where it holds backticks; in the ``cell`` of a table a bar does not end it."""
    text = " ".join(text.split()) or " "
    if cell:
        text = text.replace("|", r"\|")
    fence = "`" * (1 + max((len(run) for run in re.findall(r"`+", text)), default=0))
    space = " " if "`" in text else ""
    return f"{fence}{space}{text}{space}{fence}"


def inline_math(source: str) -> str:
    """LaTeX within a line: in dollars with backticks, so that no character in it means anything to Markdown."""
    return f"$`{hosted(source)}`$"


def display_math(lines: list[str]) -> str:
    """LaTeX lines as a block of their own."""
    body = "\n".join(lines) if len(lines) == 1 else "\\begin{aligned}\n" + " \\\\\n".join(lines) + "\n\\end{aligned}"
    return f"```math\n{hosted(body)}\n```"


def hosted(source: str) -> str:
    """LaTeX without what code hosts refuse (``\\operatorname``) and without bars, which would end a table's cell."""
    bars = {r"\|": r"\Vert ", "|": r"\vert "}
    source = re.sub(r"\\operatorname\s*\{", r"\\mathrm{", source)
    return re.sub(r"\\\\|\\\||\|", lambda match: bars.get(match.group(), match.group()), source)
