"""The engine for statements about a run: an enclosure of it, and the statement's relations on the enclosure."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import flint
import sympy as sp
from flint import arb

from ptproof.balls.ball import BALLS, ball_from, interval
from ptproof.balls.pieces import Piece
from ptproof.balls.tape import Tape, Undefined, compile_tape
from ptproof.certify.trajectory.door import enclose
from ptproof.certify.trajectory.enclosure import Enclosure
from ptproof.errors import InputError
from ptproof.proof.claim import Goal, engine
from ptproof.proof.relation import Relation
from ptproof.proof.runs import Runs
from ptproof.proof.verdict import Evidence, Verdict, Witness
from ptproof.system import System

NAME = "enclosed run"
_HALVINGS = 12


@engine
def enclosed(goal: Goal, *, width: str = "1e-6", seconds: float = 600.0) -> Evidence:
    """Decide a statement about the one run from an exact start, by :func:`ptproof.enclose`.

    Parameters
    ----------
    goal
        Its statement is an :class:`~ptproof.proof.runs.Runs` whose ``starts`` give each state a number.
    width, seconds
        As for :func:`ptproof.enclose`.

    Returns
    -------
    Evidence
        Proved only if the run is enclosed over the whole span and each relation holds everywhere in its enclosure over
        the span of time that is spoken of; refuted, where one certainly fails at an instant of it.
    """
    said = goal.statement
    if not isinstance(said, Runs):
        return _undecided("not a statement about runs")
    try:
        run = _run(said.time, said.state, said.rates, said.span, _start(said), width, seconds)
        if run.verdict is not Verdict.PROVED:
            return _undecided(f"{run.detail} ({said.time} = {run.times[-1]:.6g})")
        with flint.ctx.workprec(run.bits):
            return _decided(said, run)
    except (InputError, Undefined) as error:
        return _undecided(str(error))


def _undecided(reason: str) -> Evidence:
    return Evidence(NAME, Verdict.UNDECIDED, reason)


def _start(said: Runs) -> tuple[sp.Expr, ...]:
    """The number that each state starts from; raises :class:`InputError` where the starts say something else."""
    given = {}
    for part in said.starts:
        if part.sign != "=" or part.left not in said.state or part.left in given or part.right.free_symbols:
            raise InputError(f"a run starts from one number for each state, and not from {part}")
        given[part.left] = part.right
    if absent := [str(x) for x in said.state if x not in given]:
        raise InputError(f"no number is given that {', '.join(absent)} starts from")
    return tuple(given[x] for x in said.state)


@lru_cache(maxsize=8)
def _run(
    time: sp.Symbol, state: tuple[sp.Symbol, ...], rates: tuple[sp.Expr, ...], span: tuple[sp.Expr, sp.Expr],
    start: tuple[sp.Expr, ...], width: str, seconds: float,
) -> Enclosure:  # fmt: skip
    """The run, once for all that is said of it; letters of its own, so that no name stands for two."""
    return enclose(System(time, state, rates), initial=start, span=span, width=width, seconds=seconds)


def _decided(said: Runs, run: Enclosure) -> Evidence:
    first, last = map(ball_from, said.during)
    begin, end = map(ball_from, said.span)
    if not (said.at_once or first <= last):
        return _undecided(f"{said.during[0]} is not shown to be before {said.during[1]}")
    if not all(
        inner == outer or ball <= other
        for inner, outer, ball, other in (
            (said.during[0], said.span[0], begin, first), (said.during[1], said.span[1], last, end)
        )
    ):  # fmt: skip
        return _undecided("it speaks of instants that the runs are not shown to reach")
    when = interval(first, last)
    for part in said.parts:
        tape = compile_tape([part.left, part.right], said.letters)
        for piece in run.pieces:
            if piece.start > when or piece.start + piece.length < when:
                continue
            span = when.intersection(interval(piece.start, piece.start + piece.length))
            verdict, place = _on(tape, part, piece, span, 0 if said.at_once else _HALVINGS)
            at_ends = place == first or place.overlaps(first) or place.overlaps(last)
            if verdict is Verdict.REFUTED and (at_ends or (first <= place and place <= last)):
                return _refuted(said, part, tape, piece, place)
            if verdict is not Verdict.PROVED:
                return _undecided(f"{part} is not decided at {said.time} = {place.str(8)} in an enclosure of the run")
    return Evidence(NAME, Verdict.PROVED, f"enclosed in {run.steps} steps, each state to {run.width:.1e}")


def _on(tape: Tape, part: Relation, piece: Piece, span: arb, halvings: int) -> tuple[Verdict, arb]:
    """Whether a relation holds over a span of a step, or where it certainly fails or is not decided."""
    left, right = tape.run([span, *piece.at(span)], BALLS)
    found = _holds(part.sign, left, right)
    if found is not None:
        return (Verdict.PROVED if found else Verdict.REFUTED), span
    if not halvings:
        return Verdict.UNDECIDED, span
    middle = span.mid()
    halves = [_on(tape, part, piece, half, halvings - 1) for half in (
        interval(span.lower(), middle), interval(middle, span.upper())
    )]  # fmt: skip
    order = (Verdict.REFUTED, Verdict.UNDECIDED, Verdict.PROVED)
    verdict, place = min(halves, key=lambda half: order.index(half[0]))
    return verdict, span if verdict is Verdict.PROVED else place


def _holds(sign: str, left: Any, right: Any) -> bool | None:
    """Whether the relation holds for all values of two balls, or for none; None where that is not known."""
    if not (left.is_finite() and right.is_finite()):
        return None
    less, more = bool(left < right), bool(left > right)
    at_most, at_least = bool(left <= right), bool(left >= right)
    same = bool(at_most and at_least)
    yes, no = {
        "<": (less, at_least), "<=": (at_most, more), ">": (more, at_most), ">=": (at_least, less),
        "=": (same, less or more), "!=": (less or more, same),
    }[sign]  # fmt: skip
    return True if yes else False if no else None


def _refuted(said: Runs, part: Relation, tape: Tape, piece: Piece, place: arb) -> Evidence:
    """With the instant, at which the two sides are apart, as the witness."""
    instant = place if said.at_once else place.mid()
    left, right = tape.run([instant, *piece.at(instant)], BALLS)
    exact = said.during[0] if said.at_once else sp.Rational(str(instant.fmpq()))
    witness = Witness({str(said.time): str(exact)}, left.str(12), right.str(12))
    return Evidence(NAME, Verdict.REFUTED, f"on the run {part} fails at {said.time} = {exact}", witness=witness)
