"""What stands in which file of a derivation, as an earlier loading has found it: for one claim few files are loaded.

A file says the same as before where neither it has changed, nor a file that it imports, nor any other file that was
read. What it imports is read off its text; where that does not tell, it counts as all files of its derivation.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ptproof.reading.hashes import of_file

if TYPE_CHECKING:
    from ptproof.proof.load import Derivation

# With these a module may read others in ways that its imports do not show.
_UNCLEAR = ("importlib", "__import__", "exec(", "eval(", "sys.modules", "sys.path", "open(", "read_text", "read_bytes")


def said(derivation: Derivation, digests: Mapping[str, str], files: Sequence[Path]) -> dict[str, Any]:
    """For each of the files the words by which its claims are chosen, its ids, and the hashes of all it depends on."""
    here = {str(file.resolve()): file.resolve() for file in files}
    words: dict[str, list[str]] = {name: [] for name in here}
    ids: dict[str, list[str]] = {name: [] for name in here}
    for item in derivation.items:
        if (home := derivation.homes.get(item.id)) in here:
            ids[home].append(item.id)
            words[home] += [item.id, item.title, item.section, *item.labels]
    direct = {name: _imports(file, here) for name, file in here.items()}
    others = {name: digest for name, digest in digests.items() if name not in here}
    return {
        name: {
            "words": list(dict.fromkeys(words[name])),
            "ids": ids[name],
            "depends": others | {used: digests[used] for used in _all(name, direct)},
        }
        for name in here
        if name in digests
    }


def holding(known: Any, digests: Mapping[str, str], files: Iterable[Path], text: str) -> list[Path] | None:
    """The files that may hold a claim that contains ``text``; None where nothing is known of them."""
    chosen, wanted = [], text.lower()
    if not isinstance(known, dict) or not wanted:
        return None
    for file in files:
        entry = known.get(str(file.resolve()))
        match entry:
            case {"words": list(words), "ids": list(), "depends": dict(depends)} if depends and _same(depends, digests):
                if any(wanted in str(word).lower() for word in words):
                    chosen.append(file)
            case _:
                chosen.append(file)
    return chosen


def doubtful(known: Mapping[str, Any], few: Sequence[Path], derivation: Derivation) -> bool:
    """Whether an id of what was loaded stands in a file that was not, so that all of them have to be looked at."""
    loaded = {*map(str, few), *derivation.homes.values()}
    ids = {item.id for item in derivation.items}
    return any(ids.intersection(entry["ids"]) for name, entry in known.items() if name not in loaded)


def _same(depends: Mapping[str, str], digests: Mapping[str, str]) -> bool:
    return all(digest and (digests.get(file) or of_file(file)) == digest for file, digest in depends.items())


def _all(name: str, direct: Mapping[str, set[str]]) -> set[str]:
    """The file and all that it imports, all the way."""
    found, left = {name}, [name]
    while left:
        new = direct[left.pop()] - found
        found |= new
        left += new
    return found


def _imports(file: Path, here: Mapping[str, Path]) -> set[str]:
    """The files beside it that it imports; all of them where its text does not tell."""
    try:
        text = file.read_text(encoding="utf-8")
        tree = ast.parse(text)
    except (OSError, ValueError, SyntaxError):
        return set(here)
    if any(word in text for word in _UNCLEAR):
        return set(here)
    found: set[str] = set()
    for name, beside in _names(tree):
        other = str(file.parent / f"{name}.py")
        if other in here:
            found.add(other)
        elif beside or name in {path.stem for path in here.values()}:
            return set(here)
    return found


def _statements(node: ast.AST) -> Iterator[ast.AST]:
    """The statements below a node; imports stand among them and in no expression."""
    for part in ("body", "orelse", "handlers", "finalbody", "cases"):
        for inner in getattr(node, part, ()):
            yield inner
            yield from _statements(inner)


def _names(tree: ast.AST) -> Iterator[tuple[str, bool]]:
    """What is imported: the first part of its name, and whether it is looked for beside the file."""
    for node in _statements(tree):
        if isinstance(node, ast.Import):
            yield from ((entry.name.partition(".")[0], False) for entry in node.names)
        elif isinstance(node, ast.ImportFrom):
            if node.level == 0:
                yield str(node.module).partition(".")[0], False
            elif node.level == 1 and node.module:
                yield node.module, True
            else:
                yield from ((entry.name if node.level == 1 else "", True) for entry in node.names)
