"""The labels of a paper's equations, read from its LaTeX source.

A scanner, not a TeX engine: comments, verbatim text and ``\\iffalse`` parts are dropped, abbreviations such as
``\\newcommand{\\be}{\\begin{equation}}`` are expanded, and then environments are followed on a stack.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from ptproof.errors import InputError

_DISPLAYS = frozenset({
    "equation", "align", "gather", "multline", "flalign", "alignat", "xalignat", "xxalignat", "eqnarray", "displaymath",
    "math", "dmath", "dseries", "IEEEeqnarray", "numcases", "subnumcases", "empheq",
})  # fmt: skip
# Inside these a label still belongs to the group of equations around it.
_TRANSPARENT = frozenset(["center", "minipage", "small", "footnotesize", "scriptsize"])
_VERBATIM = re.compile(r"\\begin\{(verbatim\*?|lstlisting|comment|minted)\}.*?\\end\{\1\}", re.DOTALL)
_VERB = re.compile(r"\\verb\*?([^\w\s*]).*?\1")
_COMMENT = re.compile(r"(?<!\\)((?:\\\\)*)%[^\n]*")
_IF = re.compile(r"\\(if[a-zA-Z@]*|else|fi)(?![a-zA-Z@])")
_MACRO = re.compile(r"\\(?:newcommand|renewcommand|providecommand|def|gdef)\*?\s*(\{\s*\\[a-zA-Z@]+\s*\}|\\[a-zA-Z@]+)")
_ENVIRONMENT = re.compile(r"\\(?:re)?newenvironment\*?\s*(?=\{)")
_TOKEN = re.compile(r"\\(begin|end|label)\s*(?:\[[^\]]*\]\s*)?\{([^{}]*)\}|\\[\\\[\]]")
_INPUT = re.compile(r"\\(?:input|include|subfile)\s*\{([^{}]*)\}")


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
    for token in _TOKEN.finditer(_expanded(_without_comments(source))):
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


def read_paper(path: str | Path) -> str:
    """The LaTeX source of a paper with the files that it inputs, for :func:`equation_labels`.

    Raises
    ------
    InputError
        If the file or one that it inputs does not exist, is a folder, or is not text.
    """
    return _read(Path(path), Path(path).parent, ())


def _read(path: Path, folder: Path, above: tuple[Path, ...]) -> str:
    if path.is_dir():
        raise InputError(f"{path}: is a folder; name the LaTeX file of the paper")
    try:
        data = path.read_bytes()
    except FileNotFoundError:
        raise InputError(f"{path}: no such file; name the LaTeX file of the paper") from None
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    if re.search(rb"[\x00-\x08\x0e-\x1f]", data):
        raise InputError(f"{path}: is not a text file; name the LaTeX source of the paper")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("latin-1")
    if path in above:
        raise InputError(f"{path}: inputs itself")

    def inlined(match: re.Match[str]) -> str:
        name = match.group(1).strip()
        for candidate in (folder / name, folder / f"{name}.tex"):
            if candidate.is_file():
                return _read(candidate, folder, (*above, path))
        if match.group().startswith(r"\input"):
            return ""  # such as \input{glyphtounicode}: a file of the TeX distribution
        raise InputError(f"{path}: includes {name}, which is not beside it")

    return _INPUT.sub(inlined, _without_comments(text))


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


def _without_comments(text: str) -> str:
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    # Verbatim text first where it may hold a %, comments first where they may hold a \begin{verbatim}: a line that
    # is nothing but a comment cannot open verbatim text.
    text = re.sub(r"(?m)^[ \t]*%.*$", "", text)
    text = _VERB.sub("", _VERBATIM.sub("", text))
    return _without_false_parts(_COMMENT.sub(r"\1", text))


def _without_false_parts(text: str) -> str:
    """Drop what stands between ``\\iffalse`` and its ``\\fi`` or ``\\else``."""
    kept: list[str] = []
    levels: list[str] = []
    position = 0
    for match in _IF.finditer(text):
        if "false" not in levels:
            kept.append(text[position : match.start()])
        word = match.group(1)
        if word == "else":
            if levels and levels[-1] in ("true", "false"):
                levels[-1] = "true" if levels[-1] == "false" else "false"
        elif word == "fi":
            if levels:
                levels.pop()
        else:
            levels.append({"iffalse": "false", "iftrue": "true"}.get(word, "either"))
        position = match.end()
    if "false" not in levels:
        kept.append(text[position:])
    return "".join(kept)


def _expanded(text: str) -> str:
    """Take the definitions of commands and environments out, and expand those that open or close something."""
    macros: dict[str, str] = {}
    kept: list[str] = []
    position = 0
    while True:
        starts = [match for pattern in (_MACRO, _ENVIRONMENT) if (match := pattern.search(text, position))]
        if not starts:
            break
        start = min(starts, key=lambda match: match.start())
        kept.append(text[position : start.start()])
        if start.re is _MACRO:
            names = [start.group(1).strip("{} \t\n")]
            end = re.compile(r"[^{\\]*").match(text, start.end()).end()  # type: ignore[union-attr]
        else:
            name, end = _braced(text, start.end())
            names = [rf"\begin{{{name}}}", rf"\end{{{name}}}"]
            end = re.compile(r"\s*(\[[^\]]*\]\s*)*").match(text, end).end()  # type: ignore[union-attr]
        for word in names:
            body, end = _braced(text, end)
            if re.search(r"\\(begin|end|label)\b", body) and "#" not in body:
                macros[word] = body
        position = max(end, start.end())
    kept.append(text[position:])
    text = "".join(kept)
    if not macros:
        return text
    pattern = re.compile("|".join(re.escape(name) + ("" if name[-1] == "}" else r"(?![a-zA-Z@])") for name in macros))
    for _ in range(5):  # abbreviations of abbreviations; a circle ends here
        text = pattern.sub(lambda match: macros[match.group()], text)
    return text


def _braced(text: str, position: int) -> tuple[str, int]:
    """The content of the group that opens at the next non-blank character, and where it ends."""
    while position < len(text) and text[position].isspace():
        position += 1
    if position >= len(text) or text[position] != "{":
        return "", position
    depth, here = 0, position
    while here < len(text):
        if text[here] == "\\":
            here += 1
        elif text[here] == "{":
            depth += 1
        elif text[here] == "}":
            depth -= 1
            if depth == 0:
                return text[position + 1 : here], here + 1
        here += 1
    return text[position + 1 :], len(text)
