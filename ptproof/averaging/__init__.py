"""Lie bracket averaging of dithered systems.

>>> import sympy as sp
>>> from ptproof.averaging import average
>>> from ptproof.system import DitherSystem
>>> tau, theta, x = sp.symbols("tau theta x", real=True)
>>> omega, k = sp.symbols("omega k", positive=True)
>>> F = sp.Function("F", real=True)(x)
>>> seeker = DitherSystem(tau, theta, omega, (x,), (0,), ((1,), (k * F,)), (sp.cos(theta), sp.sin(theta)))
>>> average(seeker).rhs
(k*Derivative(F(x), x)/2,)
"""

from ptproof.averaging.average import Derived, average, derive
from ptproof.averaging.coefficients import v_matrix
from ptproof.averaging.correction import Correction, first_correction
from ptproof.averaging.ledger import Ledger, examine
from ptproof.averaging.problem import DitherProblem, FastStates
from ptproof.averaging.reading import load_dither_system, read_dither_system
from ptproof.averaging.refusal import AveragingRefused, AveragingUndecided
from ptproof.averaging.split import split_dithers
from ptproof.averaging.study import Average, study

__all__ = [
    "Average",
    "AveragingRefused",
    "AveragingUndecided",
    "Correction",
    "Derived",
    "DitherProblem",
    "FastStates",
    "Ledger",
    "average",
    "derive",
    "examine",
    "first_correction",
    "load_dither_system",
    "read_dither_system",
    "split_dithers",
    "study",
    "v_matrix",
]
