"""Second-order averages known from the literature on Newton-based extremum seeking, and near misses."""

import pytest

from ptproof.averaging import read_dither_system, study
from ptproof.proof.verdict import Verdict

SYSTEM = """
[system]
state      = {state}
parameters = ["k", "w", "a", "p"]
functions  = {{ F = ["x"] }}
order      = 2
conditions = ["1/2 < p", "p < 1"]
drift      = {drift}
period     = "2*pi"
[[system.dither]]
field  = ["a", "0", "0"]
signal = "cos(theta)"
power  = "p"
[[system.dither]]
field  = {first}
signal = "sin(theta)"
power  = "1 - p"
[[system.dither]]
field  = {second}
signal = "cos(theta)"
power  = "2 - 2*p"
frequency = "2"
[expected]
average = {average}
"""
# The measurement times sin ωt, filtered, estimates the slope, and times cos 2ωt the second derivative: on average they
# are what Newton-based extremum seeking puts together (Ghaffari, Krstić, Nešić; Labar, Garone, Kinnaert, Ebenbauer).
ESTIMATORS = {
    "state": '["x", "y", "z"]', "drift": '["0", "-w*y", "-w*z"]', "first": '["0", "2*w/a*F(x)", "0"]',
    "second": '["0", "0", "-8*w/a^2*F(x)"]',
    "average": '["0", "w*(Derivative(F(x), x) - y)", "w*(Derivative(F(x), x, x) - z)"]',
}  # fmt: skip
# The same with the slope's estimate times the state of a Riccati filter, which tends to 1/F'', as the descent.
NEWTON = ESTIMATORS | {
    "state": '["x", "y", "d"]', "drift": '["-k*d*y", "-w*y", "w*d"]', "second": '["0", "0", "8*w/a^2*d^2*F(x)"]',
    "average": '["-k*d*y", "w*(Derivative(F(x), x) - y)", "w*d*(1 - d*Derivative(F(x), x, x))"]',
}  # fmt: skip


@pytest.mark.parametrize("values", [ESTIMATORS, NEWTON], ids=["estimators", "newton"])
def test_published_average(values: dict[str, str]) -> None:
    found = study(read_dither_system(SYSTEM.format(**values))).to_json()
    assert found["expected"]["verdict"] == Verdict.PROVED.value
    assert {item["verdict"] for name, item in found["assumptions"].items() if name != "2.3"} == {Verdict.PROVED.value}


@pytest.mark.parametrize("change", [("x, x)", "x)"), ("w*(D", "2*w*(D"), ("- z", "+ z")])
def test_near_miss(change: tuple[str, str]) -> None:
    average = ESTIMATORS["average"].replace(*change)
    found = study(read_dither_system(SYSTEM.format(**ESTIMATORS | {"average": average}))).to_json()
    assert found["expected"]["verdict"] == Verdict.REFUTED.value


def test_the_last_condition_of_the_riccati_filter_needs_more_than_a_half() -> None:
    """d² times the field, four times along itself, does not vanish, as for the Newton seeker on wheels."""
    text = SYSTEM.format(**NEWTON)
    assert study(read_dither_system(text)).to_json()["assumptions"]["2.3"]["verdict"] != Verdict.PROVED.value
    far = study(read_dither_system(text.replace('"1/2 < p"', '"5/8 < p"'))).to_json()["assumptions"]["2.3"]
    assert far["verdict"] == Verdict.PROVED.value
