"""The averaging step of the unicycle seeker, from the reduced model to the Lie bracket system."""

import pytest
import sympy as sp

from ptproof.averaging import AveragingRefused, average, split_dithers, v_matrix
from ptproof.system import DitherSystem, System

tau, theta, t0 = sp.symbols("tau theta t0", real=True)
x1, x2 = x = sp.symbols("x1:3", real=True)
omega, k, T = sp.symbols("omega k T", positive=True)
F = sp.Function("F", real=True)(x1, x2)
rate = 1 / (1 + (tau - t0) / T) ** 2
drift = tuple(sp.Function(f"f{i}", real=True)(tau, x1, x2) * rate for i in (1, 2))
FIELDS = ((sp.cos(k * F), -sp.sin(k * F)), (sp.sin(k * F), sp.cos(k * F)))


def reduced(sign: int = 1) -> System:
    waves = (sp.cos(omega * tau - sign * k * F), sp.sin(omega * tau - sign * k * F))
    return System(tau, x, tuple(d + sp.sqrt(omega) * wave for d, wave in zip(drift, waves, strict=True)))


def test_angle_addition_gives_the_two_fields() -> None:
    split = split_dithers(reduced(), omega, theta)
    assert split.fields == FIELDS
    assert split.dithers == (sp.cos(theta), sp.sin(theta))
    assert split.drift == drift


def test_average_is_half_the_gain_times_the_gradient() -> None:
    averaged = average(split_dithers(reduced(), omega, theta))
    assert averaged.rhs == tuple(d + k * sp.diff(F, v) / 2 for d, v in zip(drift, x, strict=True))


def test_the_other_sign_of_the_gain_descends() -> None:
    averaged = average(split_dithers(reduced(-1), omega, theta))
    assert averaged.rhs == tuple(d - k * sp.diff(F, v) / 2 for d, v in zip(drift, x, strict=True))


def test_coefficient_of_cosine_and_sine() -> None:
    split = split_dithers(reduced(), omega, theta)
    assert v_matrix(split) == {(2, 1): sp.Rational(1, 2)}


@pytest.mark.parametrize(
    "entry",
    [
        omega * sp.cos(omega * tau - k * F),
        sp.cos(omega * tau),
        sp.sqrt(omega) * sp.cos(omega * tau) + sp.sqrt(omega),
        sp.sqrt(omega) * sp.cos(omega * tau * x2),
        sp.sqrt(omega) * sp.cos(omega * tau) ** 2,
    ],
)
def test_other_amplitudes_are_not_split(entry: sp.Expr) -> None:
    with pytest.raises(AveragingRefused):
        split_dithers(System(tau, x, (entry, sp.S.Zero)), omega, theta)


def test_products_of_fast_waves_become_harmonics() -> None:
    entry = sp.sqrt(omega) * sp.cos(omega * tau + x1) * sp.sin(2 * omega * tau)
    split = split_dithers(System(tau, x, (entry, sp.S.Zero)), omega, theta)
    assert split.dithers == (sp.cos(theta), sp.sin(theta), sp.cos(3 * theta), sp.sin(3 * theta))


def test_phase_and_frequency_are_kept_out_of_fields_and_drift() -> None:
    with pytest.raises(AveragingRefused, match="field 1"):
        average(DitherSystem(tau, theta, omega, x, (0, 0), ((omega, 0),), (sp.cos(theta),)))
    with pytest.raises(AveragingRefused, match="drift"):
        average(DitherSystem(tau, theta, omega, x, (sp.cos(theta), 0), ((1, 0),), (sp.cos(theta),)))
