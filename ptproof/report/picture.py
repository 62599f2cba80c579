"""The proof as a picture: the paper's own steps as groups, in rows from what is used to what uses it."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from ptproof.report.model import ClaimView, Section

_NUMBERED = re.compile(r"((?:\d+|[IVXLC]+)(?:[.-][0-9A-Z]+)*)\.?\s+(.*)", re.DOTALL)
_FORMS = {
    "equality": "square", "inequality": "circle", "limit": "circle", "smoothness": "diamond", "existence": "diamond",
    "runs": "pill", "statement": "pill", "citation": "pill", "observation": "pill",
}  # fmt: skip
FORMS = (
    ("square", "an equality"), ("circle", "an inequality or a limit"), ("diamond", "smoothness or existence"),
    ("pill", "in words, or of a run"),
)  # fmt: skip


@dataclass(frozen=True)
class Mark:
    """A claim in the picture: its form says what kind it is, its border whether the paper prints it."""

    claim: ClaimView

    @property
    def form(self) -> str:
        return _FORMS.get(self.claim.kind, "square")

    @property
    def printed(self) -> bool:
        """Whether the statement is the paper's own."""
        return self.claim.corrects is None and bool(self.claim.labels or self.claim.place)

    @property
    def read(self) -> bool:
        """Whether a machine has read it in the paper's source, and it is the same."""
        return self.claim.read is not None and self.claim.read.read == "equal"


@dataclass(frozen=True)
class Group:
    """One step of the paper: the sections of one number, or of one heading.

    ``uses`` are the groups from which an arrow leads here, by anchor and name; those that another arrow implies are
    left out.
    """

    number: str
    title: str
    anchor: str
    sections: tuple[Section, ...]
    uses: tuple[tuple[str, str], ...]

    @property
    def parts(self) -> tuple[tuple[Section, tuple[Mark, ...]], ...]:
        """Each section with the marks of its claims."""
        return tuple((section, tuple(Mark(claim) for claim in section.claims)) for section in self.sections)


def picture(sections: Sequence[Section]) -> tuple[tuple[Group, ...], ...]:
    """The groups in rows; each stands below those that it uses, unless they use one another."""
    import networkx as nx

    steps: dict[tuple[str, str], list[Section]] = {}
    for section in sections:
        number, title = heading(section.title)
        steps.setdefault((number, "" if number else title), []).append(section)
    of_claim = {
        claim.ref.id: place
        for place, inside in enumerate(steps.values())
        for section in inside
        for claim in section.claims
    }
    graph = nx.DiGraph()
    graph.add_nodes_from(range(len(steps)))
    for section in sections:
        for claim in section.claims:
            here = of_claim[claim.ref.id]
            for ref in (*claim.uses, *([claim.corrects] if claim.corrects else [])):
                if of_claim.get(ref.id, here) != here:
                    graph.add_edge(of_claim[ref.id], here)
    whole = nx.condensation(graph)
    reduced = nx.transitive_reduction(whole)
    first = {component: min(whole.nodes[component]["members"]) for component in whole}
    groups, rows = list(steps.items()), []
    for layer in nx.topological_generations(whole):
        row = []
        for component in sorted(layer, key=first.__getitem__):
            before = sorted(first[other] for other in reduced.predecessors(component))
            arrows = tuple((f"g-{place + 1}", "".join(groups[place][0])) for place in before)
            for place in sorted(whole.nodes[component]["members"]):
                (number, _), inside = groups[place]
                row.append(Group(number, _common(inside), f"g-{place + 1}", tuple(inside), arrows))
        rows.append(tuple(row))
    return tuple(rows)


def heading(title: str) -> tuple[str, str]:
    """The number of a section and its words, up to a colon where what follows is only a part of the step."""
    found = _NUMBERED.fullmatch(title)
    number, words = found.groups() if found else ("", title)
    return number, words.partition(":")[0].strip() or words


def _common(sections: Sequence[Section]) -> str:
    """The heading that most of the sections of a group begin with; the whole of it where there is but one."""
    if len(sections) == 1:
        number = heading(sections[0].title)[0]
        return sections[0].title[len(number) :].lstrip(". ")
    words = [heading(section.title)[1] for section in sections]
    return max(words, key=words.count)
