"""Names for Coq: every symbol and every undefined function of a claim gets an identifier of its own."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any

# What a translated statement may say besides its own names: a symbol of such a name would hide it.
WORDS = frozenset(re.findall(r"\S+", """
    Prop Set Type R Rbar nat Z IZR INR PI exp ln sin cos tan sinh cosh tanh atan sqrt Rabs Rmax Rmin Rpower rpow pow
    is_integer Rle_dec Rlt_dec Rge_dec Rgt_dec Req_EM_T Derive ex_derive is_derive RInt ex_RInt is_RInt_gen at_point
    at_left at_right locally filterlim Rbar_locally p_infty m_infty Finite True False fun forall exists if then else
    smooth_at fst snd
"""))  # fmt: skip
# The words of Coq's own grammar.
_GRAMMAR = frozenset(re.findall(r"\S+", """
    _ as at cofix else end exists exists2 fix for forall fun if in let match mod return SProp struct then using where
    with by IF Axiom Definition Theorem Lemma Parameter Variable Hypothesis Qed Proof Fixpoint Ltac Notation
"""))  # fmt: skip


def identifiers(items: Iterable[Any]) -> dict[Any, str]:
    """An identifier for each symbol or function, in a fixed order; no two are the same, and none means anything to Coq.

    Symbols that differ only in their assumptions, or a symbol and a function of one name, get different identifiers.
    """
    used = {*WORDS, *_GRAMMAR}
    names: dict[Any, str] = {}
    for item in items:
        base = as_identifier(called(item))
        name, count = base, 1
        while name in used:
            count += 1
            name = f"{base}_{count}"
        used.add(name)
        names[item] = name
    return names


def called(item: Any) -> str:
    """The name of a symbol or of an undefined function."""
    return str(item.name if hasattr(item, "name") else item.__name__)


def as_identifier(text: str) -> str:
    """``text`` in letters, digits and underscores of ASCII, as an identifier that begins with a letter.

    >>> as_identifier("x'"), as_identifier("1/nu"), as_identifier("")
    ('x_', 'v_1_nu', 'v_')
    """
    name = re.sub(r"[^A-Za-z0-9_]", "_", text)
    return name if re.match(r"[A-Za-z]", name) else f"v_{name}"


Names = Mapping[Any, str]


def fresh(name: str, names: Names) -> str:
    """The name, with what it takes at its end to be an identifier that nothing else has."""
    while name in names.values():
        name += "_"
    return name
