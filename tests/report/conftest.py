"""A small derivation with every kind of statement and verdict, and its report."""

from dataclasses import replace

import pytest

from ptproof.proof.load import load
from ptproof.proof.result import Verification
from ptproof.proof.run import conclude
from ptproof.proof.settling import with_witness
from ptproof.report.compose import compose
from ptproof.report.content import Figure, Table
from ptproof.report.letters import notation_of, title_of

INIT = '"""A sample <derivation> & its $x$."""\n'
NOTATION = """
from types import SimpleNamespace as Entry
import sympy as sp

x = sp.Symbol("x", real=True)
k = sp.Symbol("k", positive=True)
n = sp.Symbol("n", integer=True, positive=True)
G = sp.Symbol("G", nonnegative=True)
F = sp.Function("F", real=True)
NOTATION = [
    Entry(symbol=x, glyph=r"\\bar x", unit="m", meaning="place"),
    Entry(symbol=k, glyph="k", unit="1/s", meaning="gain | rate"),
    Entry(symbol=G, glyph=r"\\|\\nabla F\\|", unit="", meaning="norm"),
]
"""
CLAIMS = '''
import sympy as sp
from ptproof.proof.claim import cited, claim, definition
from ptproof.proof.engines.exact import exact
from ptproof.proof.statement import Exists, ForAll, Prose, Smooth, eq, every, ge, gt, le
from ptproof.proof.verdict import Evidence, Verdict
from .notation import F, G, k, n, x

SECTION = "1 First <part>"
square = definition("a/square", "The square", eq(sp.Symbol("s"), x**2),
                    labels=["eq:square"], prose="A *square* of $x$.")

@claim("a/printed", "The printed square", eq((x + k)**2, x**2 + k**2), labels=["eq:sum"], expected="refuted",
       grade="misprint", wrong="The mixed term 2kx | is left out.", survives="Nothing uses it & the <theorem> stands.")
def printed(goal):
    """The mixed term is missing."""
    return exact(goal)

@claim("a/corrected", "The square of a sum", eq((x + k)**2, x**2 + 2*k*x + k**2), labels=["eq:sum"], corrects=printed)
def corrected(goal):
    """Expand, as in `expand`:

    - first,
    - then.
    """
    return exact(goal)

@claim("a/lonely", "Wrong and not corrected", eq(F(x), F(x) + G), given=[ForAll((x,), ge(F(x), 0))],
       place="Section 1", expected="refuted")
def lonely(goal):
    from ptproof.proof.verdict import Witness
    return Evidence("by hand", Verdict.REFUTED, "at G = 1", witness=Witness({"G": "1", "F(x)": "0"}, "0", "1"))

@claim("a/own-mistake", "Wrong, and not in the paper", eq(k, k + 1), expected="refuted")
def own_mistake(goal):
    return exact(goal)

theorem = claim("b/theorem", "A theorem", Prose("Every field with a < b | c has a source."), expected="cited",
                uses=[corrected])(cited("A Book, Theorem 4.9"))

@claim("b/modulo", "From the theorem", every(le(-x - k, G), gt(G + 1, 0)), uses=[theorem], labels=["eq:last"])
def modulo(goal):
    return Evidence("by hand", Verdict.PROVED, "because of the theorem")

@claim("b/open", "Not decided", Exists((G,), (ge(G, x),), (x,)), expected="undecided")
def undecided(goal):
    return Evidence("search", Verdict.UNDECIDED, "tried /home/somebody/secret/place.py at 0x7f00deadbeef")

@claim("b/on-open", "From what is open", ge(G + n, 0), uses=[undecided])
def on_open(goal):
    return Evidence("by hand", Verdict.PROVED, "shown")

@claim("b/smooth", "Smooth", Smooth((x**2,), (x,), 2), expected="observed")
def smooth(goal):
    return Evidence("experiment", Verdict.OBSERVED, "seen")

@claim("b/wrong-expectation", "Recorded wrongly", eq(x, x), expected="refuted")
def wrong_expectation(goal):
    return exact(goal)
'''
SVG = b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1 1"><path d="M0 0L1 1"/></svg>'


@pytest.fixture(scope="session")
def sample(tmp_path_factory):
    folder = tmp_path_factory.mktemp("derivations") / "sample"
    folder.mkdir()
    for name, text in (("__init__", INIT), ("notation", NOTATION), ("claims", CLAIMS)):
        (folder / f"{name}.py").write_text(text)
    return folder


@pytest.fixture(scope="session")
def derivation(sample):
    return load([sample])


@pytest.fixture(scope="session")
def verification(derivation):
    # The proofs as they are, without the check that evidence comes from an engine: some are written by hand here, so
    # that every verdict occurs.
    def decided(claim):
        return replace(with_witness(claim.goal(), claim.prove(claim.goal())), content=claim.content)

    return Verification(conclude(derivation.claims, {claim.id: decided(claim) for claim in derivation.claims}), 1.25)


@pytest.fixture(scope="session")
def report(derivation, verification):
    return compose(
        verification, derivation, title=title_of(derivation), notation=notation_of(derivation),
        versions=[("sympy", "1.14.0")],
        figures=[Figure("path", "The path of x, with $k = 1$.", SVG)],
        appendix=[Table("Times", "Measured once.", ("what", "s"), (("all | of it", "1.5"),))],
        notes=["One thing could not be drawn."],
    )  # fmt: skip
