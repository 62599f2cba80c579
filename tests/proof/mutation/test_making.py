"""What is made of a claim: every kind that applies, every row, nothing twice, never the claim itself."""

from dataclasses import replace

import pytest
import sympy as sp

from ptproof.proof import Exists, ForAll, Smooth, claim, every, exact, ge, gt, le, lt
from ptproof.proof.mutation.making import mutants
from ptproof.proof.statement import Relation, eq

x, y, a1, a2 = sp.symbols("x y a1 a2", real=True)
T = sp.Symbol("T", positive=True)
V = sp.Function("V", real=True)
BASE = claim("base", "Used", eq(x + x, 2 * x))(exact)
OTHER = claim("other", "Not used", eq(x - x, 0))(exact)
RELATION = claim("relation", "", le(a1 * x**2, sp.sqrt(T) + sp.sin(a2 * y)), given=[ge(x, 0), lt(x, T)], uses=[BASE])(
    exact
)
VECTOR = claim("vector", "", eq([x + y, x - y, x, y, 1], [y + x, x - y, x, y, 1]))(exact)
CHOICE = claim("choice", "", Exists((a1, a2), (le(a1 * x, x), le(x, a2 * x + y)), (x,)))(exact)
SMOOTH = claim("smooth", "", Smooth((x**2 * y, y), (x, y), 2))(exact)
QUANTIFIED = claim("for-all", "", le(V(x), 1), given=[ForAll((y,), le(V(y), 1), (ge(y, 0),)), ge(x, 0)])(exact)

KINDS = {
    "relation": {
        "assumption changed", "assumption dropped", "assumption weakened", "coefficient", "declaration", "dependency",
        "direction", "domain", "exchange", "exponent", "function", "index", "plus", "sign", "strictness", "term",
    },
    "choice": {"quantifier", "direction", "strictness", "coefficient", "index"},
    "smooth": {"order", "kink", "exponent"},
    "for-all": {"domain", "assumption weakened", "assumption dropped", "direction"},
}  # fmt: skip


@pytest.mark.parametrize("item", [RELATION, CHOICE, SMOOTH, QUANTIFIED], ids=lambda item: item.id)
def test_each_kind_that_applies_is_there(item):
    assert KINDS[item.id] <= {mutant.kind for mutant in mutants(item, [OTHER], count=1)}


@pytest.mark.parametrize("item", [RELATION, VECTOR, CHOICE, SMOOTH, QUANTIFIED], ids=lambda item: item.id)
def test_no_mutant_is_the_original_or_another_one(item):
    contents = [mutant.claim.content for mutant in mutants(item, [OTHER], count=60)]
    assert len({item.content, *contents}) == len(contents) + 1


def test_every_row_of_a_vector_is_changed():
    changed = {
        row
        for mutant in mutants(VECTOR, count=1)
        for side in ("left", "right")
        for row in range(5)
        if getattr(mutant.claim.statement, side)[row] != getattr(VECTOR.statement, side)[row]
    }
    assert changed == set(range(5))


def test_every_part_of_a_conjunction_is_changed():
    item = claim("parts", "", every(*(gt(x**i, i) for i in range(1, 9))))(exact)
    changed = {
        i
        for mutant in mutants(item, count=1)
        for i in range(8)
        if mutant.claim.statement.parts[i] != item.statement.parts[i]
    }
    assert changed == set(range(8))


def test_every_assumption_is_dropped_or_changed():
    item = replace(RELATION, assumptions=tuple(ge(x, -i) for i in range(1, 6)))
    gone = {
        given for mutant in mutants(item, count=1) for given in set(item.assumptions) - set(mutant.claim.assumptions)
    }
    assert gone == set(item.assumptions)


def test_as_many_as_asked_for():
    assert len(mutants(RELATION, count=40)) == 40


def test_the_same_ones_each_time_and_others_with_another_seed():
    first, again, other = ([mutant.change for mutant in mutants(RELATION, seed=seed)] for seed in (0, 0, 1))
    assert first == again != other


def test_what_cannot_be_built_is_left_out():
    item = claim("integral", "", eq(sp.Integral(x, (x, 0, a1)), a1**2 / 2))(exact)
    assert all(isinstance(mutant.claim.statement, Relation) for mutant in mutants(item))


def test_a_mutant_keeps_the_id_and_the_proof():
    assert {(mutant.claim.id, mutant.claim.prove) for mutant in mutants(RELATION)} == {(RELATION.id, exact)}


def test_only_where_defined_is_taken_away():
    item = claim("quotient", "", eq(x / x**2, 1 / x), where_defined=True)(exact)
    assert any(not mutant.claim.where_defined for mutant in mutants(item))
