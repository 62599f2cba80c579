"""A small derivation with instruments, and its report."""

from dataclasses import replace

import pytest

from ptproof.proof.load import load
from ptproof.proof.result import Verification
from ptproof.proof.run import conclude
from ptproof.proof.shipped import shipped
from ptproof.report.compose import compose
from ptproof.report.instruments import instruments_of
from ptproof.report.letters import notation_of

NOTATION = """
from ptproof.report.alphabet import Alphabet

alphabet = Alphabet()
letter = alphabet.letter
NOTATION = alphabet.entries
t = letter("t", "t", "s", "time")
k = letter("k", "k", "1/s", "gain", positive=True)
E = letter("E", r"\\\\|E\\\\|", "m^{2κ}", "drift <gain> & more", nonnegative=True)
V0 = letter("V0", "V_0", "m²", "V at the start", positive=True)
"""
CLAIMS = """
import sympy as sp
from ptproof.proof import Evidence, claim, definition, eq, every, ge, gt, le, lt, ForAll
from ptproof.proof.verdict import Verdict
from .notation import E, V0, k, t

SECTION = "1 All"
V = sp.Function("V", real=True)
n = sp.Symbol("n", integer=True, positive=True)
A = sp.Symbol("A", positive=True)
falls = ForAll((t,), le(sp.Derivative(V(t), t), -(k - 2 * E) * V(t)))

@claim("bound", "V falls", le(V(t), V(0) * sp.exp(-(k - 2 * E) * t)), given=[falls, ge(t, 0), gt(k, 2 * E)])
def bound(goal):
    return Evidence("by hand", Verdict.PROVED, "shown")

@claim("power", "A power", every(gt(A, 0), eq(A, k ** (1 / n))), given=[eq(A, k ** (1 / n))])
def power(goal):
    return Evidence("by hand", Verdict.PROVED, "shown")

@claim("open", "Not decided", le(1 / (k - E), V0), expected="undecided")
def undecided(goal):
    return Evidence("search", Verdict.UNDECIDED, "tried")

gain = definition("gain", "The least gain", eq(sp.Symbol("k_min", real=True), 2 * E), labels=["eq:gain"])
"""
INSTRUMENTS = """
import sympy as sp
from ptproof.report.instruments import Condition, Curve, Instrument, Plot, Quantity, Region, Slider, Vehicle, taken
from ptproof.system import System
from .claims import V, bound, gain, n, power, undecided
from .notation import E, V0, k, t

order = sp.Symbol("kappa", integer=True, positive=True)
SLIDERS = (
    Slider(k, "0.1", 10, "3.5", logarithmic=True), Slider(E, 0, 4, 1), Slider(V0, "0.5", 2, 1), Slider(order, 2, 5, 3),
)

def instruments():
    take = lambda *a, **b: taken(a[0], SLIDERS, *a[1:], **b)
    x, y, z, w = sp.symbols("x y z w", real=True)
    yield Instrument("bounds", "Bounds <of> V", "Prose with $k$.", SLIDERS, (
        Quantity("The power", take(power, at={n: order - 1}, part=1), "right", "1/s"),
        Quantity("V at the end", take(bound, at={t: sp.S.One}, short={V0: V(0)}), "right", "m²"),
        Quantity("The least gain", take(gain), "right", "1/s"),
        Quantity("Undecided", take(undecided), "left"),
        Condition("Enough gain", take(bound, assumed=True, part=1)),
        Region("Where V falls", E, k, (take(bound, at={t: sp.Symbol("lag", nonnegative=True)}),)),
        Plot("V", t, 0, 2, (Curve("bound", take(bound, short={V0: V(0)})),), "t", "V"),
        Plot("V by gain", k, "0.1", 10, (Curve("bound", take(bound, at={t: sp.S.One}, short={V0: V(0)})),), "k", "V"),
    ), "echo {k} {E} {V0} {kappa}")
    loop = System(t, (x, y), (-k * x - E * y, E * x - k * y))
    yield Instrument("circle", "A spiral", "", SLIDERS[:2], (Vehicle(
        "Spiral", loop, System(t, (z, w), (-k * z, -k * w)), {x: 1, y: 0, z: 1, w: 0}, (0, sp.Rational(1, 2), 2), t,
        (0, 0), -(x**2 + y**2), (bound,),
    ),))
"""


@pytest.fixture(scope="session")
def tooled(tmp_path_factory):
    folder = tmp_path_factory.mktemp("derivations") / "tooled"
    folder.mkdir()
    for name, text in (
        ("__init__", '"""A derivation with instruments."""\n'), ("notation", NOTATION), ("claims", CLAIMS),
        ("instruments", INSTRUMENTS),
    ):  # fmt: skip
        (folder / f"{name}.py").write_text(text)
    return load([folder])


@pytest.fixture(scope="session")
def tools(tooled):
    return tuple(instruments_of(tooled))


@pytest.fixture(scope="session")
def tooled_report(tooled, tools):
    decided = {claim.id: replace(claim.prove(claim.goal()), content=claim.content) for claim in tooled.claims}
    verification = Verification(conclude(tooled.claims, decided), 1.0)
    return compose(verification, tooled, title="Tooled", notation=notation_of(tooled), instruments=tools)


@pytest.fixture(scope="session")
def of_papers():
    """The instruments of both papers, each as it is loaded for everything else."""
    return {name: tuple(instruments_of(load([shipped() / name]))) for name in ("pt_seeker", "newton_seeker")}
