"""The files of a drafted derivation as text: a module for each section, the letters, and the table of notation."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Iterator, Mapping, Sequence

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.drafting.entries import SIGNS, commented, entry
from ptproof.drafting.facts import Fact
from ptproof.drafting.headings import Heading
from ptproof.drafting.items import Item
from ptproof.drafting.paper import Paper
from ptproof.drafting.printing import laid_out
from ptproof.drafting.stated import Conditions
from ptproof.drafting.toml import toml
from ptproof.reading.latex.formulas import Formula

_WIDTH = 112
_WORDS = (
    "Relation", "claim", "definition", "eq", "every", "exact", "gap", "ge", "gt", "integrals", "le", "limits", "lt",
    "reals",
)  # fmt: skip
_PUT = '''

def put(said: Relation, *definitions: Relation) -> Relation:
    """What is said, with the functions that these equations define put in, whatever they are applied to."""

    def side(value: Any) -> Any:
        for known in definitions:
            at = sp.Lambda(known.left.args, known.right)
            value = value.replace(known.left.func, at)
        return value.xreplace({node: node.doit() for node in value.atoms(sp.Derivative, sp.Subs)})

    return said.map(side)
'''


def texts(paper: Paper, items: Sequence[Item], functions: Mapping[str, str], source: str) -> dict[str, str]:
    """The text of each file by its name.

    ``functions`` has what functions mean for every argument; ``source`` is what the paper's file is called.
    """
    table = {**paper.table, "means": {**paper.table["means"], **functions}}
    found = {
        "__init__.py": _package(paper, source),
        "notation.py": _notation(paper, source, any(item.puts for item in items)),
        "notation.toml": toml(table, _table_head(source)),
    }
    for heading in paper.outline.headings:
        own = [item for item in items if item.heading == heading]
        running = [item for item in paper.running if paper.outline.heading(item.line) == heading]
        if own or heading.line:
            found[f"{heading.file}.py"] = _section(heading, own, running, source)
    return found


def _package(paper: Paper, source: str) -> str:
    title = paper.outline.title or source
    body = f"""\
Drafted from {source} by `ptproof new --from`. Nobody has looked at it yet: each letter's kind and each formula is
what a machine took it for. Each claim says what the paper prints, and `expected` is left at "proved", since that is
what the paper says: whatever `ptproof verify` does not show counts as not as expected, until you have dealt with it.

1. In notation.py say what each letter is: sign, unit, meaning. In notation.toml mend what was guessed wrong.
2. Hold each formula against the paper and take "letters guessed" out of its title.
3. A claim that is false as printed gets expected="refuted", and a corrected one beside it with corrects=.
4. A gap becomes a claim that you write yourself."""
    return f"{_quoted(f'{_one_line(title)}.{chr(10)}{chr(10)}{body}{chr(10)}')}\n"


def _quoted(text: str) -> str:
    """A docstring: no quotation marks or backslashes that would end or change it."""
    safe = text.replace("\\", "/").replace('"""', "'''")
    return f'"""{safe}"""'


def _one_line(text: str) -> str:
    return " ".join(text.split()).rstrip(".") or "A paper"


def _table_head(source: str) -> str:
    return (
        f"What the LaTeX of {source} means, for reading its formulas (`ptproof coverage`): all of it is guessed.\n"
        "Values are names of notation.py. ptproof/reading/latex/notation.py explains every key."
    )


def _notation(paper: Paper, source: str, puts: bool) -> str:
    letters = [item for item in paper.declared.values() if not item.function]
    functions = [item for item in paper.declared.values() if item.function]
    rates = [item for item in letters if item.name in paper.rates]
    used = ["Relation"] * puts + sorted({SIGNS[item.pair.sign] for item in paper.conditions.taken})
    lines = [
        f'"""The letters of {_quoted(source)[3:-3]}, each once, as a machine found them.',
        "",
        "All are real. What the paper says of their signs and bounds stands at the end. The rest is for the author to",
        "say: their units, what they mean, and signs that hold throughout, as in",
        '`k = letter("k", "k", "1/s", "gain", positive=True)`.',
        '"""',
        "",
        *(["from typing import Any", ""] if puts else []),
        *(["import sympy as sp", ""] if puts or functions else []),
        *([f"from ptproof.proof import {', '.join(used)}"] if used else []),
        "from ptproof.report.alphabet import Alphabet",
        "",
        "alphabet = Alphabet()",
        "letter = alphabet.letter",
        "NOTATION = alphabet.entries",
        "",
    ]
    for item in letters:
        if item.name not in paper.rates:
            first = f"first on line {item.line}" if item.line else "named by no formula itself"
            lines.append(f'{item.name} = letter("{item.name}", {_raw(item.glyph)}, "", "{first}")')
    if rates:
        lines += ["", "# What moves has a rate, a letter of its own; notation.toml says of what it is the rate."]
        for item in rates:
            of, time = paper.moved[item.name]
            lines.append(f'{item.name} = letter("{item.name}", {_raw(item.glyph)}, "", "rate of {of} along {time}")')
    if functions:
        lines += ["", "# Functions: smooth, real, and otherwise unknown."]
        lines += [f'{item.name} = sp.Function("{item.name}", real=True)' for item in functions]
    lines += _stated(paper.conditions)
    return "\n".join(lines) + "\n" + (_PUT if puts else "")


def _stated(conditions: Conditions) -> Iterator[str]:
    """What the paper says of letters alone: what claims assume, and as comments what is left to the author."""
    if conditions.taken:
        yield "\n# What the paper says of its letters; each claim assumes what is said of its own letters (`given`)."
    for item in conditions.taken:
        yield from commented(f"line {item.line}: {item.text}", "")
        yield laid_out(f"{item.name} = {SIGNS[item.pair.sign]}", (item.pair.left, item.pair.right))
    if conditions.left:
        yield "\n# Not assumed, since it may hold in one place only:"
    for remark in dict.fromkeys(f"line {item.line}: {item.text} ({why})" for item, why in conditions.left):
        yield from commented(remark, "    ")


def _raw(text: str) -> str:
    return f'r"{text}"' if '"' not in text and not text.endswith("\\") and text.isprintable() else repr(text)


def _section(heading: Heading, items: Sequence[Item], running: Sequence[Formula], source: str) -> str:
    entries = [entry(item) for item in items]
    head = [_quoted(f"{_one_line(heading.words)}: what {source} displays there, as a machine read it."), ""]
    used = "\n".join(entries)
    if items:
        head += list(_imports(items, heading.file, used))
    head += [f'SECTION = "{_quoted(heading.words)[3:-3].replace(chr(34), chr(39))}"']
    if not items:
        head += ["", "# No formula is displayed here."]
    tail = []
    if running:
        tail = ["", "", "# Relations in running text, which nothing states yet:"]
        tail += [line for item in running for line in commented(f"line {item.line}: {item.text}")]
    return "\n".join([*head, *(f"\n\n{entry}" for entry in entries), *tail]) + "\n"


def _imports(items: Sequence[Item], file: str, used: str) -> Iterator[str]:
    called = {word for word in _WORDS if f"{word}(" in used}
    if "sp." in used:
        yield "import sympy as sp\n"
    yield f"from ptproof.proof import {', '.join(sorted(called))}\n"
    names = {"put"} if any(item.puts for item in items) else set()
    facts: dict[str, set[str]] = {}
    for item in items:
        for pair in (
            *item.pairs,
            *item.others,
            *item.conditions,
            *(fact.said for fact in item.facts if not fact.chain),
        ):
            names |= _names(pair.left) | _names(pair.right)
        for fact in item.facts:
            names |= _names(fact.shift) if fact.shift is not None else set()
        for rule in item.rules:
            names |= {rule.head.name, *(of for of, _ in rule.chain), *(name for _, name in rule.chain if name)}
            names |= {str(fact.head) for put in rule.inner for fact in put}
        names |= {stated.name for stated in item.stated}
    for fact in _facts_used(items):
        if fact.file != file:
            facts.setdefault(fact.file, set()).add(fact.name)
    if names:
        yield _from("notation", names)
    for other in sorted(facts):
        yield _from(other, facts[other])
    yield ""


def _facts_used(items: Iterable[Item]) -> Iterator[Fact]:
    for item in items:
        yield from (*item.givens, *item.known)
        for used in item.puts.values():
            yield from used
        for rule in item.rules:
            yield from rule.uses


def _from(module: str, names: Iterable[str]) -> str:
    line = f"from .{module} import {', '.join(sorted(names))}"
    if len(line) <= _WIDTH:
        return line
    inside = textwrap.fill(", ".join(sorted(names)) + ",", _WIDTH, initial_indent="    ", subsequent_indent="    ")
    return f"from .{module} import (\n{inside}\n)"


def _names(expression: sp.Expr) -> set[str]:
    symbols = {node.name for node in expression.atoms(sp.Symbol) if node.name.isidentifier()}  # no sides of limits
    return symbols | {node.func.__name__ for node in expression.atoms(AppliedUndef)}
