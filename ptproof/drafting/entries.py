"""One entry of a section file as Python: a definition, a claim or a gap."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Sequence

import sympy as sp

from ptproof.drafting.facts import Fact
from ptproof.drafting.items import Item
from ptproof.drafting.printing import laid_out, python
from ptproof.reading.latex.formulas import Formula
from ptproof.reading.latex.statements import Pair

SIGNS = {"=": "eq", "<=": "le", "<": "lt", ">=": "ge", ">": "gt"}
_WIDTH = 112


def entry(item: Item) -> str:
    formula = item.formula
    lines = list(commented(f"{formula.place}, line {formula.line}:"))
    if item.kind == "gap":
        return "\n".join([*lines, _gap(item)])
    lines += commented(formula.text, "    ")
    for remark in item.remarks:
        lines += commented(f"Not read: {remark}")
    for rule in item.rules:
        lines += ["# By the chain rule; what has no rate of its own is taken for a constant.", _rule(rule)]
    lines += [
        laid_out(f"{fact.name} = {SIGNS[fact.said.sign]}", (fact.said.left, fact.said.right)) for fact in item.facts
    ]
    lines.append(_definition(item) if item.kind == "definition" else _claim(item))
    return "\n".join(lines)


def commented(text: str, space: str = "") -> Iterator[str]:
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
    if pair.sign in SIGNS:
        return laid_out(SIGNS[pair.sign], (pair.left, pair.right), indent)
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
    relations = [f"    {fact.name}{_shifted(fact)}" for fact in (*item.facts, *item.known)] + [
        _relation(pair, 4) for pair in item.others
    ]
    title = _plain(item.formula.place)
    said = "Assumed, or a condition: nothing to decide."
    if item.facts or item.known:
        said = "As the paper has it here." if item.facts else "The paper says it again."
    return "\n".join([
        f"{item.variable} = definition(",
        f"    {item.id!r}, {f'{title}: letters guessed'!r},",
        *_statement(relations),
        f"    {', '.join(_where(item.formula))}, prose={f'{said} Read by a machine.'!r},",
        ")",
    ])  # fmt: skip


def _shifted(fact: Fact) -> str:
    """What makes of the fact the relation that the paper has."""
    if fact.shift is None:
        return ""
    return f".map(lambda side: side.subs({fact.head.args[0]}, {python(fact.shift)}))"


def _claim(item: Item) -> str:
    where = ", ".join(part for part in _where(item.formula) if part != "labels=[]")
    given = [_put(fact.name, item.puts.get(fact.pair, ())) for fact in item.givens]
    given += [_put(_relation(pair, 0), item.puts.get(pair, ())) for pair in item.conditions]
    given += [stated.name for stated in item.stated]
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
    # Exact algebra puts in what letters are; a law that is not solved for its rate has to be reasoned with.
    plain = not any(fact.written for fact in item.givens)
    return "exact" if plain and all(pair.sign == "=" for pair in item.pairs) else "reals"


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
