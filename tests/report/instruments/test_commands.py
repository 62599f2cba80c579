"""The shell commands beside the papers' instruments: they run as they stand, and give the numbers of the page."""

import json
import re
import shlex
import subprocess
import sys
from itertools import pairwise

import pytest
import sympy as sp
from click.testing import CliRunner

from ptproof.commands.gains import gains
from ptproof.report.instruments.instrument import Quantity, Vehicle
from ptproof.report.instruments.taken import compared
from ptproof.report.instruments.view import decided, decimal, evaluated, filled

MOVED = [
    {},
    {"k": "2.3", "T": "0.7", "E_norm": "0.6", "a1": "0.71", "V0": "0.002", "kappa": "3", "d": "0.3", "nu_min": "0.4"},
    {"k": "4.1", "T": "1.9", "E_norm": "2.2", "b2": "1.7", "R0": "1.1", "nu_min": "0.25", "kappa": "4", "V0": "0.001"},
]  # fmt: skip
NAMES = ("gain", "critical", "clip", "bounded-drift", "vanishing", "nonvanishing", "unsaturated")


@pytest.fixture(scope="module")
def papers(of_papers):
    return {tool.name: tool for tool in of_papers["pt_seeker"]}


def placed(tool, moved):
    return {**tool.start, **{item: sp.Rational(moved[item.name]) for item in tool.symbols if item.name in moved}}


def leaf(content, key):
    for name in key.split("."):
        content = content[name]
    return content


def test_these_are_the_instruments_with_a_command(papers):
    assert tuple(papers) == NAMES


@pytest.mark.parametrize("moved", MOVED, ids=["first", "second", "third"])
@pytest.mark.parametrize("name", NAMES[:4])
def test_the_gains_are_those_of_the_command_line(papers, name, moved):
    tool = papers[name]
    values, checked = placed(tool, moved), 0
    words = shlex.split(filled(tool, {symbol: float(value) for symbol, value in values.items()}))
    assert words[:2] == ["ptproof", "gains"]
    content = json.loads(CliRunner().invoke(gains, [*words[2:], "--json"], standalone_mode=False).stdout)
    for part in tool.of(Quantity):
        if part.key:
            found = leaf(content, part.key)
            claimed = all(decided(compared(item), values) for item in part.taken.needs(tool.symbols))
            assert (found is not None) == claimed
            if found is not None:
                assert float(sp.sympify(found["value"])) == pytest.approx(evaluated(part.value, values), rel=1e-9)
                checked += 1
    assert checked


def said(command, folder, program):
    """What the shell prints where ``ptproof`` is the program."""
    command = re.sub(r"^ptproof ", f"{program} ", command, flags=re.MULTILINE)
    done = subprocess.run(["sh", "-c", command], cwd=folder, capture_output=True, text=True, check=True, timeout=200)
    return done.stdout


@pytest.mark.parametrize("moved", [{}, {"k": "2.3", "omega": "44", "E_norm": "0.6", "x_start": "1.25", "heading": "-1"},
                                   {"T": "0.8", "nu_min": "0.4", "mu": "0.004", "y_start": "0.5"}],
                         ids=["first", "second", "third"])  # fmt: skip
@pytest.mark.parametrize("name", NAMES[4:])
def test_the_vehicle_is_that_of_the_command_line(papers, name, moved, tmp_path, monkeypatch):
    """One as it stands; of the others the shell says what the program is told, which does it in this process."""
    from ptproof.commands.simulate import simulate as program
    from ptproof.simulation import simulate

    tool = papers[name]
    values = placed(tool, moved)
    command = filled(tool, {symbol: float(value) for symbol, value in values.items()}) + " --json"
    assert re.search(r"\{\w+\}", command) is None
    if not moved and name == NAMES[4]:
        content = json.loads(said(command, tmp_path, f"{shlex.quote(sys.executable)} -m ptproof"))
    else:
        called, *told = said(command, tmp_path, "printf '%s\n'").splitlines()
        assert called == "simulate"
        monkeypatch.chdir(tmp_path)
        content = json.loads(CliRunner().invoke(program, told, standalone_mode=False, catch_exceptions=False).stdout)
    (part,) = tool.of(Vehicle)
    for system, key in zip((part.system, part.beside), part.keys, strict=True):
        now = [float(part.starts[state].xreplace(values)) for state in system.state]
        own = {symbol: value for symbol, value in values.items() if symbol in system.parameters}
        edges = [float(edge.xreplace(values)) for edge in part.edges]
        for span in pairwise(edges):
            now = [float(v) for v in simulate(system, initial=now, span=span, parameters=own, rtol=1e-11).x[:, -1]]
        assert leaf(content, key) == pytest.approx(now[:2], abs=1e-8)


def test_decimals_are_as_javascript_writes_them():
    assert [decimal(value) for value in (1.0, 0.3, 100.0, 1e-3, 44.0)] == ["1", "0.3", "100", "0.001", "44"]
