"""The tactics that are tried on a proposition, with hints that SymPy finds: Coq checks each of them or fails.

A hint is a rearrangement (a difference as a product, a variable as a bound and what is above it) or a product of what
is not negative. None of them is believed.
"""

from __future__ import annotations

import contextlib
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

import sympy as sp
from sympy.core.function import AppliedUndef

from ptproof.proof.kernel.hints.atoms import Atoms
from ptproof.proof.kernel.hints.cases import KINDS
from ptproof.proof.kernel.hints.certificates import certificate
from ptproof.proof.kernel.hints.comparisons import solved
from ptproof.proof.kernel.hints.derived import Derived, derived
from ptproof.proof.kernel.hints.direct import by_bisection, by_growth_of_parts, by_logarithms, by_norms, directly
from ptproof.proof.kernel.hints.equations import by_equations
from ptproof.proof.kernel.hints.goals import Goal
from ptproof.proof.kernel.hints.instances import Instance, instances
from ptproof.proof.kernel.hints.instances import lines as instance_lines
from ptproof.proof.kernel.hints.integrals import integrals
from ptproof.proof.kernel.hints.limits import near
from ptproof.proof.kernel.hints.pieces import by_equal_pieces, by_two_inequalities
from ptproof.proof.kernel.hints.reduced import reduced_proposition
from ptproof.proof.kernel.hints.refuted import by_refutation
from ptproof.proof.kernel.hints.replay import Replay
from ptproof.proof.kernel.hints.search import by_steps
from ptproof.proof.kernel.hints.told import Told, in_other_words, relevant, text_of
from ptproof.proof.kernel.hints.values import by_values
from ptproof.proof.kernel.hints.witnesses import shown_for, witnesses
from ptproof.proof.kernel.names import Names, fresh
from ptproof.proof.kernel.obligations import Part
from ptproof.proof.kernel.smooth import script as smoothness
from ptproof.proof.kernel.terms import NoTranslation
from ptproof.proof.kernel.theorem import Proposition, inside
from ptproof.proof.statement import Relation
from ptproof.proof.steps import Chosen, Step

# Of the thread's processor time, for the hints of one proposition. The scripts that Coq accepted took 11 s at most, but
# for two with 19 and 22 s; the others up to 75 s.
_SECONDS = 20.0


def script(
    said: Proposition, *, thorough: bool = False, lemmas: Mapping[str, Proposition] | None = None,
    steps: Sequence[Step] = (),
) -> str:  # fmt: skip
    """The tactics for the whole proposition, as one sentence for Coq; the thorough ones take longer to find and try.

    With ``lemmas``, by the contents of their claims, they are for what follows from these by the ``steps`` of a proof.
    """
    said = reduced_proposition(said)
    until = time.thread_time() + _SECONDS
    assumed = (part.relation for part in said.premises if part.limit is None)
    told = (item for item in assumed if item is not None and item.sign != "!=" and not _trivial(item))
    known = list(dict.fromkeys(told))
    given = [fresh(f"given_{number}", said.names) for number in range(len(said.premises))]
    if lemmas or steps:
        sought, before = _replayed(said, known, given, lemmas or {}, steps, thorough, until)
    else:
        sought, before = _instantiated(said, known, given, thorough, until)
    said = sought.said
    leaves = [_near(part, said, thorough) if part.limit is not None else _leaf(part, sought.narrowed(part))
              for part in said.conclusions]  # fmt: skip
    shown = [f"try (assert ({part.text}) by (solve [ {leaf} ]))"
             for part, leaf in zip(said.conclusions, leaves, strict=True) if part.relation is not None]  # fmt: skip
    leaves = [smoothness(part, shown) or leaf for part, leaf in zip(said.conclusions, leaves, strict=True)]
    # Coq would rename a variable that is called like a constant of its own.
    # What the others need: a sum that is not 0.
    early = [line for part, line in zip((p for p in said.conclusions if p.relation is not None), shown, strict=True)
             if part.limit is None and part.relation and part.relation.sign == "!=" and part.relation.left.is_Add
             and not part.relation.left.is_positive]  # fmt: skip
    lines = [
        *before,
        *early,
        *(["cbv beta in *"] if "((fun " in said.text else []),
        *integrals([part.relation for part in said.conclusions if part.relation], said.names),
    ]
    return f"{'; '.join(lines)}; pieces; [> {' | '.join(leaves)} ]"


def _begun(said: Proposition, given: Sequence[str], lemmas: Iterable[str] = ()) -> list[str]:
    """All that is given has a name, and stands there as the hints write it."""
    names = [*lemmas, *said.binders, *given]
    return [*([f"intros {' '.join(names)}"] if names else []), "intros", "facts",
            *(["cbv beta in *"] if "((fun " in said.text else [])]  # fmt: skip


def _instantiated(
    said: Proposition, known: list[Relation], given: Sequence[str], thorough: bool, until: float
) -> tuple[_Sought, list[str]]:
    """What the leaves are shown from, with instances of what is assumed for all values; and the lines for these."""
    found = instances(said, known)
    solutions = list(solved(said.claim, known, said.names))
    instantiated = (item for instance in found for item in instance.plain())
    known = list(dict.fromkeys([*known, *instantiated, *(item for item, _ in solutions)]))
    plain = tuple(item for item in known if not item.has(AppliedUndef))

    def shown_by(item: Relation) -> Iterator[str]:
        goal = Goal(item, plain, said.names)
        yield from directly(goal)
        if thorough:
            yield from _by_steps(goal, said)

    hypotheses = {part.text: name for part, name in zip(said.premises, given, strict=True)}
    lines = [
        *_begun(said, given),
        *instance_lines(found, said, hypotheses, shown_by),
        *(f"try ({line})" for _, line in solutions),
        *(["facts"] if found else []),
    ]
    return _Sought(said, tuple(known), tuple(derived(known, said)), tuple(found), thorough, until), lines


def _replayed(
    said: Proposition, known: list[Relation], given: Sequence[str], lemmas: Mapping[str, Proposition],
    steps: Sequence[Step], thorough: bool, until: float,
) -> tuple[_Sought, list[str]]:  # fmt: skip
    """The same after the steps of a proof, which put the lemmas to use."""
    told = Told(dict(said.names), known, [])
    named = {content: (told.new(f"used_{number}"), lemma) for number, (content, lemma) in enumerate(lemmas.items())}
    told.lines += _begun(said, given, (name for name, _ in named.values()))
    chosen = {symbol: value for step in steps if isinstance(step, Chosen) for symbol, value in step.values}
    sought = _Sought(said, (), (), (), False, until, chains=True, chosen=chosen)
    more = tuple(derived(known, said))
    # What has to be defined is shown while little is known: Coq looks at all of it for each step of arithmetic.
    alone = replace(sought, known=tuple(known))
    told.lines += [
        f"try (assert ({part.text}) by (timeout 3 (solve [ {_leaf(part, alone)} ])))"
        for part in said.conclusions
        if part.relation is not None and part.relation.right == 0 and not part.relation.has(AppliedUndef)
    ]

    def leaf(part: Part, known: Sequence[Relation], names: Names) -> str:
        return _leaf(part, replace(sought, said=replace(said, names=names), known=tuple(known)).narrowed(part))

    Replay(said, named, tuple(given), leaf).take(steps, told)
    now = replace(said, names=told.names)
    return replace(sought, said=now, known=tuple(dict.fromkeys(told.known)), more=more, thorough=thorough), told.lines


def _tried(*hints: str) -> str:
    """Each of the tactics that proves all, one after the other; Coq says what is left."""
    return "; ".join([*(f"try (solve [ {hint} ])" for hint in hints), "leaf_or_say"])


def _near(part: Part, said: Proposition, thorough: bool) -> str:
    tries = ["near_by_sign", "near_smoothly"] if thorough else []
    with contextlib.suppress(NoTranslation, sp.PolynomialError):
        tries.append(near(part, list(said.conclusions), said.names))
    if part.limit and part.limit.args[2] is sp.oo and (part.domain or part.limit.args[0].has(sp.log)):
        tries.append("far_away")
    return _tried(*tries)


def _trivial(relation: Relation) -> bool:
    """Whether the relation is what the symbol is declared to be."""
    return bool(relation.right == 0 and relation.left.is_Symbol and relation.left.is_positive)


@dataclass(frozen=True)
class _Sought:
    """What all leaves are shown from: what is known, what follows in one step, and instances of assumptions."""

    said: Proposition
    known: tuple[Relation, ...]
    more: tuple[Derived, ...]
    found: tuple[Instance, ...]
    thorough: bool
    until: float  # of the thread's processor time: what is looked for later is only what is quick
    chains: bool = False
    every: tuple[Relation, ...] = ()  # what is known before it was narrowed
    chosen: Mapping[sp.Basic, sp.Expr] = field(default_factory=dict)  # values that are shown to exist

    def narrowed(self, part: Part) -> _Sought:
        """With less to look at, where much is known by lemmas."""
        if part.relation is None or not self.chains:
            return self
        return replace(self, known=tuple(relevant(part.relation, self.known)), every=self.known)

    def goal(self, relation: Relation) -> Goal:
        return Goal(relation, self.known, self.said.names)


def _leaf(part: Part, sought: _Sought) -> str:
    if sought.thorough and time.thread_time() > sought.until:
        sought = replace(sought, thorough=False)
    if part.exists is not None and (sought.thorough or sought.chosen) and (hint := _witnessed(part, sought)):
        return _tried(hint)
    if part.base is not None and part.exponent is not None and (sought.thorough or sought.chains):
        if part.exponent.is_negative:
            return _tried(f"cbv beta; left; {_leaf(Part('', Relation(sp.S.Zero, '<', part.base)), sought)}")
        signs = Relation(part.base, ">=", sp.Integer(0)), Relation(part.exponent, ">", sp.Integer(0))
        base, exponent = (_leaf(Part("", sign), sought) for sign in signs)
        plainly, shown = "rpow_defined; [ sign | exponent_sign ]", f"rpow_defined_as; [> {base} | {exponent} ]"
        return _tried(*(f"cbv beta; apply {way}" for way in (plainly, shown)))
    if part.relation is None or _trivial(part.relation):
        return _tried("everywhere", "derivable") if sought.thorough else _tried(*["derivable"] * sought.chains)
    if part.relation.sign == "!=" and part.relation.left.is_positive:
        return _tried("cbv beta; sign", f"cbv beta; nonzero_as {sought.goal(part.relation).text(part.relation.left)}")
    goal = sought.goal(part.relation)
    if part.relation.sign == "=":
        return _equal(goal, sought, "sqrt" in part.text)
    tries: list[str] = []
    # Before what looks at all that is known: it has less to look at.
    focused = ""
    if sought.chains and (same := in_other_words(part.relation, sought.every or sought.known)) is not None:
        focused = f"try (solve [ as_claimed ({text_of(same, sought.said.names)}) ltac:(assumption) ]); "
    elif (sought.chains or sought.thorough) and time.thread_time() < sought.until:
        with contextlib.suppress(NoTranslation, sp.PolynomialError):
            hints = by_refutation(replace(goal, known=sought.every or sought.known))
            focused = "".join(f"try (solve [ {hint} ]); " for hint in hints)
    if sought.more or sought.thorough or sought.chains:
        with contextlib.suppress(NoTranslation, sp.PolynomialError):
            tries += certificate(part.relation, sought.known, sought.said.names, sought.more)
    ways = () if tries else (by_norms, directly, by_logarithms)
    if sought.thorough:
        tries += _thoroughly(goal, sought)
    elif sought.chains:
        tries += _by_values(goal, sought)
    for way in ways:
        with contextlib.suppress(NoTranslation, sp.PolynomialError):
            tries += way(goal)
    powers = sp.Tuple(part.relation.left, part.relation.right).atoms(sp.Pow)
    if part.relation.sign != "!=" and any(not power.exp.is_number for power in powers):
        tries.append("by_growth")
    tries += (*by_bisection(goal), *by_growth_of_parts(part.relation, sought.known))
    return f"cbv beta; {focused}quickly; {_tried(*tries)}"


def _thoroughly(goal: Goal, sought: _Sought) -> Iterator[str]:
    """By several steps, where it matters with numbers for the values of unknown functions."""
    yield from _by_values(goal, sought)
    if not sought.found:
        yield from _by_steps(goal, sought.said)


def _by_values(goal: Goal, sought: _Sought) -> Iterator[str]:
    """The goal with numbers for the values of unknown functions, closed like one without them."""

    def close(inner: Goal) -> Iterator[str]:
        with contextlib.suppress(NoTranslation, sp.PolynomialError):
            if inner.relation.sign == "=":
                yield from by_equations(inner)
            else:
                yield from certificate(inner.relation, inner.known, inner.names)
        if sought.thorough:
            yield from _by_steps(inner, sought.said)

    with contextlib.suppress(NoTranslation, sp.PolynomialError):
        yield from by_values(goal, sought.found, close)


def _witnessed(part: Part, sought: _Sought) -> str:
    """The witnesses one after the other, and then the body for them."""
    said, known = sought.said, sought.known
    values = sought.chosen or (witnesses(part.exists, known) if part.exists else None)
    if part.exists is None or not values or not set(part.exists.variables) <= set(values):
        return ""
    later = [item for item in inside(said.claim) if isinstance(item, Relation)]
    there = replace(sought, known=(*known, *later), every=(*(sought.every or known), *later), more=())
    return shown_for(part, part.exists, values, said.names, lambda item: _leaf(item, there))


def _by_steps(goal: Goal, said: Proposition) -> Iterator[str]:
    """After what is quick; the ways of this module close what the steps leave."""
    given = (part.relation for part in said.premises if part.limit is None)
    return by_steps(goal.with_known(*(item for item in given if item is not None and item.sign == "!=")), [directly])


def _equal(goal: Goal, sought: _Sought, roots: bool) -> str:
    """Powers of one base by each other, and angles at the ends of integrals, before anything else is tried."""
    relation = goal.relation
    atoms = Atoms.over(goal.names)
    atoms.choose((relation.left, relation.right))
    try:
        relation.map(atoms)
    except NoTranslation:
        return _tried()
    powers = [line for line in atoms.lines if "power_as" in line]
    if relation.has(sp.Integral) and relation.has(sp.sin, sp.cos):
        return _tried("; ".join([*powers, "at_multiples_of_PI", "rational"]))
    quick = ["; ".join([*powers, "rational"])] if powers else []
    with contextlib.suppress(NoTranslation, sp.PolynomialError):
        quick += by_equations(goal)
        quick += by_equal_pieces(goal)
        if sought.chains or any(item.has(*KINDS) for item in sought.known):
            quick += by_two_inequalities(replace(goal, known=sought.every or sought.known))
    if sought.thorough:
        quick += _thoroughly(goal, sought)
    last = ["derivatives; by_squares_of_roots"] if roots else []
    return f"cbv beta; {_tried(*quick, 'progress simple_values; rational', *last)}"
