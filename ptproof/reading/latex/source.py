"""The LaTeX source of a paper: the files that it inputs, what is not printed, abbreviations of environments.

A scanner, not a TeX engine. Whatever is taken out leaves its line ends behind, so that lines keep their numbers.
"""

from __future__ import annotations

import re
from pathlib import Path

from ptproof.errors import InputError

_VERBATIM = re.compile(r"\\begin\{(verbatim\*?|lstlisting|comment|minted)\}.*?\\end\{\1\}", re.DOTALL)
_VERB = re.compile(r"\\verb\*?([^\w\s*]).*?\1")
_COMMENT = re.compile(r"(?<!\\)((?:\\\\)*)%[^\n]*")
_IF = re.compile(r"\\(if[a-zA-Z@]*|else|fi)(?![a-zA-Z@])")
_MACRO = re.compile(r"\\(?:newcommand|renewcommand|providecommand|def|gdef)\*?\s*(\{\s*\\[a-zA-Z@]+\s*\}|\\[a-zA-Z@]+)")
_ENVIRONMENT = re.compile(r"\\(?:re)?newenvironment\*?\s*(?=\{)")
_INPUT = re.compile(r"\\(?:input|include|subfile)\s*\{([^{}]*)\}")


def read_paper(path: str | Path) -> str:
    """The LaTeX source of a paper with the files that it inputs in their places.

    Raises
    ------
    InputError
        If the file or one that it inputs does not exist, is a folder, or is not text.
    """
    return _read(Path(path), Path(path).parent, ())


def absent_inputs(path: str | Path) -> tuple[str, ...]:
    r"""What a paper inputs by ``\\input`` and is not beside it, so that nothing of it was read."""
    folder = Path(path).parent
    text = _decoded(Path(path).read_bytes())
    named = (match.group(1).strip() for match in _INPUT.finditer(without_comments(text)))
    return tuple(name for name in named if not any((folder / f"{name}{end}").is_file() for end in ("", ".tex")))


def _decoded(data: bytes) -> str:
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")


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
    text = _decoded(data)
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

    return _INPUT.sub(inlined, without_comments(text))


def without_comments(text: str) -> str:
    """The text without comments, verbatim text and what ``\\iffalse`` switches off."""
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    # Verbatim text first where it may hold a %, comments first where they may hold a \begin{verbatim}: a line that
    # is nothing but a comment cannot open verbatim text.
    text = re.sub(r"(?m)^[ \t]*%.*$", "", text)
    text = _VERB.sub("", _VERBATIM.sub(lambda match: "\n" * match.group().count("\n"), text))
    return _without_false_parts(_COMMENT.sub(r"\1", text))


def _without_false_parts(text: str) -> str:
    """Drop what stands between ``\\iffalse`` and its ``\\fi`` or ``\\else``."""
    kept: list[str] = []
    levels: list[str] = []
    position = 0
    for match in _IF.finditer(text):
        part = text[position : match.start()]
        kept.append("\n" * part.count("\n") if "false" in levels else part)
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


def expanded(text: str) -> str:
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
            name, end = braced(text, start.end())
            names = [rf"\begin{{{name}}}", rf"\end{{{name}}}"]
            end = re.compile(r"\s*(\[[^\]]*\]\s*)*").match(text, end).end()  # type: ignore[union-attr]
        for word in names:
            body, end = braced(text, end)
            if re.search(r"\\(begin|end|label)\b", body) and "#" not in body:
                macros[word] = body
        position = max(end, start.end())
        kept.append("\n" * text.count("\n", start.start(), position))
    kept.append(text[position:])
    text = "".join(kept)
    if not macros:
        return text
    pattern = re.compile("|".join(re.escape(name) + ("" if name[-1] == "}" else r"(?![a-zA-Z@])") for name in macros))
    for _ in range(5):  # abbreviations of abbreviations; a circle ends here
        text = pattern.sub(lambda match: macros[match.group()], text)
    return text


def braced(text: str, position: int) -> tuple[str, int]:
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
