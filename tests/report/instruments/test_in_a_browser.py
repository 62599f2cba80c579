"""The instruments in a real browser, where there is one: it has the numbers that Python has, and the page moves."""

import json
import math
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import sympy as sp

from ptproof.report.instruments.instrument import Condition, Plot, Quantity, Region, Vehicle
from ptproof.report.instruments.javascript import HELPERS, function
from ptproof.report.instruments.script import script_of
from ptproof.report.instruments.view import decided, evaluated
from ptproof.report.pages import report_files
from tests.report.instruments.chromium import looked
from tests.report.test_browser import chromium as chromium
from tests.report.test_browser import look_at
from tests.report.test_browser import tab as tab

x, y = sp.symbols("x y", real=True)
POINTS = [(a, b) for a in (-2.5, -1, -0.25, 0, 0.5, 1, 3) for b in (-3, -0.5, 0, 1, 2.25)]
PRINTED = [
    x**2, x**-3, sp.sqrt(x), x ** sp.Rational(2, 3), sp.real_root(x, 3), x**y, (x**2 + 1) ** -y, -(x**2), x / y / 3,
    2 * x * (x - y) / (3 * y), sp.exp(-(x**2)), sp.log(x), sp.Abs(x - y), sp.sign(x), sp.floor(x / 2),
    sp.ceiling(x * y),
    sp.Mod(x, 2), sp.Mod(x, -2), -2 * sp.Mod(x, y), sp.Mod(-x, 3) ** 2, sp.Max(x, y, 0), sp.Min(x, y) ** 2,
    sp.Heaviside(x), sp.Heaviside(x - 1, 1), sp.atan2(x, y), sp.cosh(x) - sp.sinh(y), sp.tanh(x * y), sp.asin(x),
    sp.acosh(y), sp.cbrt(x**2), sp.pi * x + sp.E, sp.Piecewise((x, x < 0), (y, x < 1), (x * y, True)),
    sp.Piecewise((x, sp.And(x > 0, y > 0)), (y, sp.Or(x < -1, sp.Not(y < 2)))),
    sp.Piecewise((1, sp.log(x) < 0), (2, True)),
    sp.Piecewise((x, sp.Ne(x, 1)), (7, True)), sp.sqrt(sp.Max(x, y)) / (sp.Abs(x) + 1), 1 / (x - 1), x / (x - y),
    sp.Rational(1, 3) - x, sp.Pow(0, x, evaluate=False), sp.exp(1000 * x), sp.Rational(7, 2) ** x, -x * -y - -x,
]  # fmt: skip
NAMES = {"x": x, "y": y}


@pytest.fixture(scope="module")
def printed(tmp_path_factory):
    """Each expression at each point, as the browser has it."""
    look = f"""<!doctype html><meta charset="utf-8"><pre id="said"></pre><script>{HELPERS}
    const f = {function(PRINTED, NAMES)};
    const found = {json.dumps(POINTS)}.map(([a, b]) => f(a, b).map(String));
    document.getElementById("said").textContent = JSON.stringify(found);
    </script>"""
    return looked(tmp_path_factory.mktemp("printed"), look)


@pytest.mark.parametrize("place", range(len(PRINTED)), ids=[str(item) for item in PRINTED])
def test_an_expression_has_the_value_that_sympy_gives(printed, place):
    source = PRINTED[place]
    for values, found in zip(POINTS, printed, strict=True):
        exact = evaluated(source, dict(zip((x, y), map(sp.Rational, values), strict=True)))
        assert same(float(found[place].replace("Infinity", "inf")), exact), (source, values, found[place], exact)


def same(found, exact):
    """Equal to a billionth; what is not finite and real is nothing that a page shows as a number."""
    if not math.isfinite(exact):
        return not math.isfinite(found) or abs(found) > 1e300
    return math.isclose(found, exact, rel_tol=1e-9, abs_tol=1e-12)


# --- What the papers bring ---

LOOK = Path(__file__).with_name("papers.html").read_text("utf-8")


def spoilt(tool):
    """The same with its first number off by a hundred-millionth."""
    place = next(n for n, part in enumerate(tool.parts) if isinstance(part, Quantity))
    taken = tool.parts[place].taken
    other = replace(taken, relation=taken.relation.map(lambda side: side * (1 + sp.Rational(1, 10**8))))
    parts = [*tool.parts]
    parts[place] = replace(parts[place], taken=other)
    return replace(tool, parts=tuple(parts))


def positions(tool, count, seed):
    """Random positions as exact decimals, the first ones in front, and where on a plot's axis to look."""
    random = np.random.default_rng(seed)
    yield tuple(slider.start for slider in tool.sliders), sp.Rational(1, 2)
    for _ in range(count):
        found = []
        for slider in tool.sliders:
            low, high = float(slider.lowest), float(slider.highest)
            share = random.random()
            value = low * (high / low) ** share if slider.logarithmic else low + (high - low) * share
            text = str(round(value)) if slider.symbol.is_integer else f"{value:.4g}"
            found.append(min(max(sp.Rational(text), slider.lowest), slider.highest))
        yield tuple(found), sp.Rational(f"{random.random():.3g}")


@pytest.fixture(scope="module")
def asked(of_papers, tmp_path_factory):
    """The instruments of both papers, and a spoilt one; where they were looked at, and what was found there."""
    tools = [tool for tools in of_papers.values() for tool in tools]
    tools.append(spoilt(tools[0]))
    places = [list(positions(tool, 25, seed)) for seed, tool in enumerate(tools)]
    folder = tmp_path_factory.mktemp("papers")
    (folder / "script.js").write_text(script_of(tools), encoding="utf-8")
    data = [
        [{"s": list(map(float, s)), "v": float(v), "whole": n < 2} for n, (s, v) in enumerate(own)] for own in places
    ]
    return tools, places, looked(folder, LOOK.replace("ASKED", json.dumps(data)))


def number(text):
    return float(text.replace("Infinity", "inf"))


def differences(tool, places, found):
    """What the browser has otherwise than Python: the title, the position, and both values."""
    for (s, share), said in zip(places, found, strict=True):
        values, place = dict(zip(tool.symbols, s, strict=True)), 0
        for part in tool.of(Quantity, Condition):
            if isinstance(part, Condition):
                exact = decided(part.value, values)
                exact = math.nan if exact is None else float(exact)
            else:
                exact = evaluated(part.value, values)
            if not same(number(said["values"][place]), exact):
                yield part.title, values, said["values"][place], exact
            place += 1 + 2 * isinstance(part, Condition) + len(part.taken.needs(tool.symbols))
        for part, drawn in zip(tool.of(Plot, Region, Vehicle), said["pictures"], strict=True):
            if isinstance(part, Region) and number(drawn[0]) != float(bool(decided(part.value, values))):
                yield part.title, values, drawn, None
            if isinstance(part, Plot):
                low, high = (sp.sympify(end).xreplace(values) for end in (part.lowest, part.highest))
                there = {**values, part.variable: low + share * (high - low)}
                for n, curve in enumerate(part.curves):
                    within, exact = curve.domain({*tool.symbols, part.variable}), evaluated(curve.value, there)
                    if number(drawn[2 * n + 1]) != float(bool(decided(within, there))):
                        yield part.title, there, drawn[2 * n + 1], "domain"
                    elif drawn[2 * n + 1] == "1" and not same(number(drawn[2 * n]), exact):
                        yield part.title, there, drawn[2 * n], exact


def test_every_number_of_the_papers_is_pythons(asked):
    tools, places, found = asked
    assert sum(len(tool.of(Quantity, Condition, Plot, Region)) for tool in tools[:-1]) > 15
    wrong = [list(differences(*of)) for of in zip(tools[:-1], places, found, strict=False)]
    assert [item for of in wrong for item in of] == []


def test_a_number_that_is_off_is_noticed(asked):
    tools, places, found = asked
    assert len(list(differences(tools[0], places[-1], found[-1]))) > 20


def test_every_vehicle_ends_where_pythons_does(asked):
    from ptproof.simulation import simulate

    tools, places, found = asked
    ran = 0
    for tool, own, said in zip(tools, places, found, strict=True):
        for n, part in enumerate(tool.of(Plot, Region, Vehicle)):
            if not isinstance(part, Vehicle):
                continue
            for (s, _), drawn in list(zip(own, said, strict=True))[:2]:
                values = dict(zip(tool.symbols, s, strict=True))
                edges = [float(edge.xreplace(values)) for edge in part.edges]
                for system, place, at in zip(
                    (part.system, part.beside), part.places, drawn["pictures"][n], strict=True
                ):
                    now = [float(part.starts[state].xreplace(values)) for state in system.state]
                    for span in pairwise(edges):
                        own_values = {symbol: value for symbol, value in values.items() if symbol in system.parameters}
                        run = simulate(system, initial=now, span=span, parameters=own_values, rtol=1e-12)
                        now = [float(value) for value in run.x[:, -1]]
                    where = sp.lambdify([system.time, system.state], [e.xreplace(values) for e in place], "math")
                    np.testing.assert_allclose([float(one) for one in at], where(edges[-1], now), rtol=1e-9, atol=1e-9)
                    ran += 1
    assert ran >= 12


# --- The page ---

PAGE = Path(__file__).with_name("page.html").read_text("utf-8")
HEARD = b"<head><script>var errors = []; addEventListener('error', (e) => errors.push(e.message), true);</script>"


@pytest.fixture(scope="module")
def page(tooled_report, tmp_path_factory):
    folder = tmp_path_factory.mktemp("page")
    for name, content in report_files(tooled_report, single=True).items():
        (folder / name).write_bytes(content.replace(b"<head>", HEARD, 1))
    return looked(folder, PAGE)


FAULTS = ("wide", "flat", "axe", "faint", "print")
FIRST = ["1.87083", "0.22313", "2", "0.4", "holds"]
SAID = {
    "errors": [], "flaws": [], "first": FIRST, "reset": FIRST, "single": FIRST, "printed": FIRST,
    "after": ["2.64575", "0.00247875", "1", "0.153846", "holds"],
    "moved": ["1.87083", "1.64872", "4", "0.666667", "does not hold"],
    "region": "The sliders stand outside: nothing is proved here.",
    "command": "echo 3.5 2 1 3", "range": 200, "needs": 1, "hash": "#i-bounds:E=2", "end": "10", "words": "10 1/s",
    "whole": "3", "clamped": "10", "infinite": "not defined", "empty": "#i-bounds:", "focusable": True, "later": "0.5",
    "restored": ["2.64575", "0.00247875", "1", "0.153846", "holds"], "playing": "❚❚ Pause", "paused": "▶ Run",
    "redrawn": [False, True, True], "wide 390": 0, "wide 1280": 0, "wide 1920": 0,
}  # fmt: skip


@pytest.mark.parametrize("what", SAID)
def test_the_page_moves(page, what):
    assert page[what] == SAID[what]


def test_the_vehicle_of_the_page_runs_to_its_end(page):
    end = [math.exp(-7) * value for value in (math.cos(2), math.sin(2))]
    words = ", ".join(f"{value:.6g}".replace("-", "−") for value in end)
    assert page["run"][0].startswith(f"vehicle: at t = 2 s, at ({words})")
    assert page["path"] > 200


def test_the_page_has_no_fault(tab, tooled_report, tmp_path):
    """At three widths, on paper, light and dark, and by axe, as every page is looked at; its script is asked above."""
    for name, content in report_files(tooled_report).items():
        (tmp_path / name).write_bytes(content)
    seen = look_at(tab, tmp_path / "instruments.html")
    assert {fault: seen[fault] for fault in FAULTS if seen[fault]} == {}
