"""Dithers that turn with the state: where all fields depend on θ − A(x, z) only, that is the better phase."""

from __future__ import annotations

import itertools

import sympy as sp

from ptproof.averaging.brackets import Vector
from ptproof.averaging.fractions import Fractions, reading
from ptproof.averaging.refusal import AveragingUndecided
from ptproof.proof.kinks import innermost
from ptproof.system import DitherSystem

_MOST = 4


def rotating(system: DitherSystem, turned: sp.Symbol) -> tuple[sp.Expr, Vector] | None:
    """(A, Σ b_i u_i as a function of ``turned`` = θ − A), or None where no such A is found among the fields' angles.

    Guaranteed by exact algebra: with θ = turned + A the sum is what is returned, and that is free of A's sine and
    cosine. A vehicle whose heading is θ − kz is averaged with the heading as its phase this way.
    """
    theta = system.phase
    if any(innermost(dither, {theta}) is not None for dither in system.dithers):
        return None
    waves = sum_of_waves(system)
    found = set().union(*(entry.atoms(sp.sin, sp.cos) for field in system.fields for entry in field))
    angles = {node.args[0] for node in found if not node.args[0].is_number}
    if len(angles) > _MOST:
        return None
    for angle, sign in itertools.product(sorted(angles, key=str), (1, -1)):
        written = _written(waves, theta, turned, sign * angle)
        if written is not None:
            return sign * angle, written
    return None


def sum_of_waves(system: DitherSystem) -> Vector:
    """Σ b_i u_i."""
    pairs = [*zip(system.fields, system.dithers, strict=True)]
    return tuple(sp.Add(*(field[row] * dither for field, dither in pairs)) for row in range(len(system.state)))


def _written(waves: Vector, theta: sp.Symbol, turned: sp.Symbol, angle: sp.Expr) -> Vector | None:
    try:
        return reading(lambda algebra: _in_algebra(waves, theta, turned, angle, algebra), most=96)
    except AveragingUndecided:
        return None


def _in_algebra(
    waves: Vector, theta: sp.Symbol, turned: sp.Symbol, angle: sp.Expr, algebra: Fractions
) -> Vector | None:
    result = []
    for wave in waves:
        value = algebra.simplest(algebra.read(wave.xreplace({theta: turned + angle})))
        left = {node.args[0] for node in algebra.letters(value) if isinstance(node, sp.sin | sp.cos)}
        if any(argument.free_symbols != {turned} for argument in left):
            return None
        result.append(algebra.expression(value))
    return tuple(result)
