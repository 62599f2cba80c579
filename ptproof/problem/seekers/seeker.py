"""A seeker as a record: its law and what else the package has to know of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import sympy as sp

from ptproof.problem.drift import Drift
from ptproof.problem.seekers.law import Letters
from ptproof.system import System

Law = Callable[[sp.Expr, Drift | Sequence[sp.Expr], sp.Expr, Letters], System]
Inputs = Callable[[sp.Expr, sp.Expr, Letters], Mapping[str, sp.Expr]]


@dataclass(frozen=True)
class Seeker:
    """One way to seek. The package offers it wherever seekers are chosen, once a file of this folder has it as SEEKER.

    Attributes
    ----------
    name
        What the user writes.
    words
        What it is, for the help of the commands.
    law
        From field, drift, gain K and the states' letters to the closed loop in ``TIME``, with the symbols of
        :class:`ptproof.problem.model.parameters`; its first states are the position.
    inputs
        From field, gain and letters to what it applies, by name.
    gain
        K where it is constant; None for the rate of the problem's clock. τ is the clock with this rate.
    averaged
        Whether θ + kz turns at the rate ω in τ, so that it has reduced coordinates, a reduced model and an average.
    tables
        The tables beyond those of every problem file that it needs. A problem that has them is meant for it: of all
        seekers whose tables a problem has, its default is the first with the most.
    commands
        The commands that offer it.
    rank
        Its place in lists, the smaller the earlier.
    """

    name: str
    words: str
    law: Law
    inputs: Inputs
    gain: sp.Expr | None = None
    averaged: bool = True
    tables: tuple[str, ...] = ()
    commands: tuple[str, ...] = ("simulate",)
    rank: int = 100
