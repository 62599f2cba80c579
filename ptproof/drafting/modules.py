"""The files of a drafted derivation as text: a module for each section, the letters, and the table of notation."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Iterator, Mapping, Sequence

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.drafting.headings import Heading
from ptproof.drafting.items import Fact, Item
from ptproof.drafting.paper import Paper
from ptproof.drafting.printing import laid_out, python
from ptproof.drafting.toml import toml
from ptproof.reading.latex.formulas import Formula
from ptproof.reading.latex.statements import Pair

_SIGNS = {"=": "eq", "<=": "le", "<": "lt", ">=": "ge", ">": "gt"}
_WIDTH = 112
_PUT = '''

def put(said: Relation, *definitions: Relation) -> Relation:
    """What is said, with the functions that these equations define put in, wherever and to whatever they are applied."""

    def side(value: Any) -> Any:
        for known in definitions:
            at = dict.fromkeys(known.left.args)
            value = value.replace(
                known.left.func,
                lambda *given, known=known, at=at: known.right.subs(dict(zip(at, given, strict=True)), simultaneous=True),
            )
        return value.xreplace({node: node.doit() for node in value.atoms(sp.Derivative)})

    return said.map(side)
'''


def texts(paper: Paper, items: Sequence[Item], functions: Mapping[str, str], source: str) -> dict[str, str]:
    """The text of each file by its name.

    ``functions`` has what functions mean for every argument; ``source`` is what the paper's file is called.
    """
    table = {**paper.table, "means": {**paper.table["means"], **functions}}
    found = {
        "__init__.py": _package(paper, source),
        "notation.py": _notation(paper, source),
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
Drafted from {source} by `ptproof new --from`. Nobody has looked at it yet: each letter's kind and each formula is what a
machine took it for. Each claim says what the paper prints, and `expected` is left at "proved", since that is what the
paper says: whatever `ptproof verify` does not show to be so counts as not as expected, until you have dealt with it.

1. In notation.py say what each letter is: its sign, its unit, its meaning. In notation.toml mend what was guessed wrong.
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


def _notation(paper: Paper, source: str) -> str:
    letters = [item for item in paper.declared.values() if not item.function]
    functions = [item for item in paper.declared.values() if item.function]
    lines = [
        f'"""The letters of {_quoted(source)[3:-3]}, each once, as a machine found them.',
        "",
        "All are real, and that is all: which are positive, their units and what they mean is for the author to say, as in",
        '`k = letter("k", "k", "1/s", "gain", positive=True)`.',
        '"""',
        "",
        "from typing import Any",
        "",
        "import sympy as sp",
        "",
        "from ptproof.proof import Relation",
        "from ptproof.report.alphabet import Alphabet",
        "",
        "alphabet = Alphabet()",
        "letter = alphabet.letter",
        "NOTATION = alphabet.entries",
        "",
    ]
    rates = [item for item in letters if item.name in paper.rates]
    for item in letters:
        if item.name not in paper.rates:
            first = f"first on line {item.line}" if item.line else "an entry"
            lines.append(f'{item.name} = letter("{item.name}", {_raw(item.glyph)}, "", "{first}")')
    if rates:
        lines += ["", "# What moves has a rate, a letter of its own; notation.toml says of what it is the rate."]
        for item in rates:
            of, time = paper.moved[item.name]
            lines.append(f'{item.name} = letter("{item.name}", {_raw(item.glyph)}, "", "rate of {of} along {time}")')
    if functions:
        lines += ["", "# Functions: smooth, real, and otherwise unknown."]
        lines += [f'{item.name} = sp.Function("{item.name}", real=True)' for item in functions]
    return "\n".join(lines) + "\n" + _PUT


def _raw(text: str) -> str:
    return f'r"{text}"' if '"' not in text and not text.endswith("\\") and text.isprintable() else repr(text)


def _section(heading: Heading, items: Sequence[Item], running: Sequence[Formula], source: str) -> str:
    entries = [_entry(item) for item in items]
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
        tail += [line for item in running for line in _commented(f"line {item.line}: {item.text}")]
    return "\n".join([*head, *(f"\n\n{entry}" for entry in entries), *tail]) + "\n"


def _imports(items: Sequence[Item], file: str, used: str) -> Iterator[str]:
    called = {word for word in ("Relation", "claim", "definition", "eq", "every", "exact", "gap", "ge", "gt", "integrals",
                                "le", "limits", "lt", "reals") if f"{word}(" in used}  # fmt: skip
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
            *(fact.pair for fact in item.facts if not fact.chain),
        ):
            names |= _names(pair.left) | _names(pair.right)
        for rule in item.rules:
            names |= {rule.head.name, *(of for of, _ in rule.chain), *(name for _, name in rule.chain if name)}
            names |= {str(fact.head) for put in rule.inner for fact in put}
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


def _entry(item: Item) -> str:
    formula = item.formula
    lines = list(_commented(f"{formula.place}, line {formula.line}:"))
    if item.kind == "gap":
        return "\n".join([*lines, _gap(item)])
    lines += _commented(formula.text, "    ")
    for remark in item.remarks:
        lines += _commented(f"Not read: {remark}")
    for rule in item.rules:
        lines += ["# By the chain rule; what has no rate of its own is taken for a constant.", _rule(rule)]
    lines += [
        laid_out(f"{fact.name} = {_SIGNS[fact.pair.sign]}", (fact.pair.left, fact.pair.right)) for fact in item.facts
    ]
    lines.append(_definition(item) if item.kind == "definition" else _claim(item))
    return "\n".join(lines)


def _commented(text: str, space: str = "") -> Iterator[str]:
    for line in text.splitlines():
        stripped = "".join(sign if sign.isprintable() else " " for sign in line.expandtabs(2).strip())
        if stripped:
            wrapped = textwrap.wrap(stripped, _WIDTH - len(space), break_on_hyphens=False) or [stripped]
            yield from (f"# {space}{part}" for part in wrapped)


def _where(formula: Formula) -> list[str]:
    if formula.labels:
        return [f"labels={list(map(_plain, formula.labels))!r}"]
    return ["labels=[]", f"place={_plain(formula.place)!r}"]


def _plain(text: str) -> str:
    return "".join(sign for sign in text if sign.isprintable())


def _gap(item: Item) -> str:
    formula = item.formula
    latex = formula.text if formula.text.count("\n") else formula.text.strip()
    raw = latex.isascii() and '"""' not in latex and not latex.endswith(("\\", '"')) and "\r" not in latex
    written = f'r"""{latex}"""' if raw else repr(latex)
    labels = f", {_where(formula)[0]}" if formula.labels else ""
    return (
        f"{item.variable} = gap(\n    {item.id!r}, {_plain(formula.place)!r}, {formula.line},\n    {written},\n"
        f"    {_plain(item.why)!r}{labels},\n)"
    )


def _relation(pair: Pair, indent: int) -> str:
    if pair.sign in _SIGNS:
        return laid_out(_SIGNS[pair.sign], (pair.left, pair.right), indent)
    return f"{' ' * indent}Relation({python(pair.left)}, {pair.sign!r}, {python(pair.right)})"


def _statement(relations: Sequence[str]) -> list[str]:
    """The relations, each with an indent of four, as one statement."""
    if len(relations) == 1:
        return [f"{relations[0]},"]
    return ["    every(", *(textwrap.indent(f"{relation},", "    ") for relation in relations), "    ),"]


def _put(relation: str, used: Sequence[Fact]) -> str:
    """The relation with the definitions of its functions put in."""
    if not used:
        return relation
    bare = relation.lstrip()
    return f"{relation[: len(relation) - len(bare)]}put({bare}, {', '.join(fact.name for fact in used)})"


def _definition(item: Item) -> str:
    relations = [f"    {fact.name}" for fact in (*item.facts, *item.known)] + [
        _relation(pair, 4) for pair in item.others
    ]
    title = _plain(item.formula.place)
    said = "Assumed, or a condition: nothing to decide."
    if item.facts or item.known:
        said = "As the paper has it first." if item.facts else "The paper says it again."
    return "\n".join([
        f"{item.variable} = definition(",
        f"    {item.id!r}, {f'{title}: letters guessed'!r},",
        *_statement(relations),
        f"    {', '.join(_where(item.formula))}, prose={f'{said} Read by a machine.'!r},",
        ")",
    ])  # fmt: skip


def _claim(item: Item) -> str:
    where = ", ".join(part for part in _where(item.formula) if part != "labels=[]")
    given = [_put(fact.name, item.puts.get(fact.pair, ())) for fact in item.givens]
    given += [_put(_relation(pair, 0), item.puts.get(pair, ())) for pair in item.conditions]
    lines = [
        "@claim(",
        f"    {item.id!r}, {f'{_plain(item.formula.place)}: letters guessed'!r},",
        *_statement([_put(_relation(pair, 4), item.puts.get(pair, ())) for pair in item.pairs]),
    ]
    if given:
        inside = f"    given=[{', '.join(given)}],"
        lines += [inside] if len(inside) <= _WIDTH and "\n" not in inside else [
            "    given=[", *(textwrap.indent(f"{entry},", " " * 8) for entry in given), "    ],"
        ]  # fmt: skip
    return "\n".join([
        *lines,
        f"    {where},",
        ")",
        f"def {item.variable}(goal):",
        *_docstring(item),
        f"    return {_engine(item)}(goal)",
    ])  # fmt: skip


def _docstring(item: Item) -> list[str]:
    said = f'    """As a machine read it on line {item.formula.line}; what its letters are is guessed.'
    if not item.again:
        return [f'{said}"""']
    names = ", ".join(str(fact.head) for fact in item.again)
    more = f"The paper has said before what {names} is. Where it means another one here, give it a letter of its own."
    return [said, "", *textwrap.wrap(more, _WIDTH, initial_indent="    ", subsequent_indent="    "), '    """']


def _engine(item: Item) -> str:
    """The engine whose kind of statement this is."""
    sides = [side for pair in item.pairs for side in (pair.left, pair.right)]
    if any(side.has(sp.Limit) for side in sides):
        return "limits"
    if any(side.has(sp.Integral) for side in sides):
        return "integrals"
    return "exact" if all(pair.sign == "=" for pair in item.pairs) else "reals"


def _rule(rule: Fact) -> str:
    value = f"{rule.uses[0].name}.right"
    for put in rule.inner:
        value += f".subs({{{', '.join(f'{fact.head}: {fact.name}.right' for fact in put)}}})"
    terms = [f"sp.diff({value}, {of})" + (f" * {name}" if name else "") for of, name in rule.chain]
    one = f"{rule.name} = eq({rule.head}, {' + '.join(terms)})"
    if len(one) <= _WIDTH:
        return one
    first, *rest = terms
    inside = "\n".join(f"    {line}" for line in (f"{rule.head},", first, *(f"+ {term}" for term in rest)))
    return f"{rule.name} = eq(\n{inside},\n)"
