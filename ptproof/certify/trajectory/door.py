"""The door: an enclosed run of a problem or a system."""

from __future__ import annotations

import time as clock
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import flint
import sympy as sp
from flint import arb

from ptproof.balls.ball import ball_from, interval
from ptproof.balls.pieces import Piece, Region
from ptproof.balls.rounding import down, up
from ptproof.balls.tape import Undefined
from ptproof.certify.trajectory.enclosure import Enclosure
from ptproof.certify.trajectory.march import March, Stopped
from ptproof.certify.trajectory.modes import stretches
from ptproof.errors import InputError
from ptproof.problem import Problem, example
from ptproof.problem.loops import check_word
from ptproof.proof.verdict import Verdict
from ptproof.reading.expressions import parse
from ptproof.system import System

MODELS = ("closed loop", "reduced model", "average")
_BITS = 96
_FINEST, _COARSEST = 2e-15, 1e-10


def enclose(
    target: Problem | System | str, seeker: str | None = None, frame: str = "t", *,
    initial: Mapping[str, Any] | Sequence[Any] | None = None, span: tuple[Any, Any] | None = None,
    until: Any = None, model: str = "closed loop", width: Any = "1e-6", seconds: float = 60.0,
    progress: Callable[[float], None] | None = None,
) -> Enclosure:  # fmt: skip
    """Enclose a run rigorously: a theorem about the trajectory with these exact initial data.

    What is enclosed is the right-hand side that :func:`ptproof.simulate` integrates. Each step's theorem, with its
    hypotheses and its proof, stands at :func:`ptproof.balls.flow.flow`; steps across kinks (Max, Min, Abs), at
    :func:`ptproof.balls.flow.across`.

    Parameters
    ----------
    target
        A :class:`Problem`, an example's name, or a :class:`System` without parameters (which needs ``initial`` and
        ``span``).
    seeker, frame, model
        For a problem: as for :func:`ptproof.simulate`.
    initial
        Exact initial states, in order or by name: integers, fractions, expressions, or text; a pair is an interval, all
        of whose values are enclosed at once. A problem's own are used for those left out.
    span, until
        (start, end) for a system; for a problem another end than t₀ + T, in t.
    width
        The width that is wanted of each state at each of the times, the larger ones relative to their size.
    seconds
        The limit of wall time, after which the run is enclosed as far as it came.
    progress
        Told the share of the run that is done.

    Returns
    -------
    Enclosure
        ``undecided`` where no proof was found, such as near an escape in finite time.

    Raises
    ------
    InputError
        For bad input, and for a right-hand side that may jump.

    Examples
    --------
    >>> import sympy as sp
    >>> from ptproof import System, enclose
    >>> t, x, y = sp.symbols("t x y", real=True)
    >>> turning = System(t, (x, y), (-y, x))
    >>> run = enclose(turning, initial=(1, 0), span=(0, 2 * sp.pi), width="1e-9")
    >>> str(run.verdict), run.final["x"][0] <= 1 <= run.final["x"][1]
    ('proved', True)
    """
    begin = clock.monotonic()
    aim = _width(width)
    system, values, first, last = _asked(target, seeker, frame, initial, span, until, model)
    _plain(system)
    return _closely(system, values, (first, last), aim, begin, seconds, progress)


def _closely(
    system: System, values: Mapping[str, Any], ends: tuple[sp.Expr, sp.Expr], aim: arb, begin: float, seconds: float,
    progress: Callable[[float], None] | None,
) -> Enclosure:  # fmt: skip
    """Once more with smaller tolerances, as long as there is time, where the enclosure is not as close as asked for."""
    first, last = ends
    with flint.ctx.workprec(_BITS):
        start, whole = float(ball_from(first)), float(ball_from(last - first))
        tolerance = min(max(float(aim) * 2e-6, _FINEST), _COARSEST)
        while True:
            march = March(Region.around(_balls(values)), tolerance, begin + seconds)
            if progress is not None:
                march.progress = lambda now: progress((now - start) / whole)
            reason = _through(march, system, first, last)
            found = _enclosure(march, system, values, first, reason, aim, clock.monotonic() - begin)
            if found.verdict is Verdict.PROVED or tolerance <= _FINEST or clock.monotonic() - begin > seconds / 3:
                return found
            tolerance = max(tolerance / 30, _FINEST)


def _through(march: March, system: System, first: sp.Expr, last: sp.Expr) -> str:
    try:
        for start, end, choices in stretches(system, first, last):
            march.through(choices, start, end)
    except (Stopped, Undefined) as error:
        return str(error)
    return ""


def _enclosure(
    march: March, system: System, values: Mapping[str, Any], first: sp.Expr, reason: str, aim: arb, seconds: float
) -> Enclosure:
    nodes = [_node(ball_from(first), _balls(values), march.pieces[:1], up)]
    nodes += [_node(p.start + p.length, end, [p], down) for p, end in zip(march.pieces, march.ends, strict=True)]
    times, rows = [time for time, _ in nodes], [row for _, row in nodes]
    wide = [
        time for time, row in zip(times, rows, strict=True)
        if not all(2 * ball.rad() <= aim * abs(ball).upper().max(arb(1)) for ball in row)
    ]  # fmt: skip
    if not reason and wide:
        reason = f"the run is enclosed, but from {system.time} = {wide[0]:.6g} on less closely than asked for"
    return Enclosure(
        Verdict.UNDECIDED if reason else Verdict.PROVED, reason or "enclosed to its end",
        tuple(symbol.name for symbol in system.state), system.time.name, tuple(times),
        tuple(tuple(map(down, row)) for row in rows), tuple(tuple(map(up, row)) for row in rows),
        tuple(march.pieces), tuple(march.switches), _BITS, seconds,
    )  # fmt: skip


def _node(
    instant: arb, box: list[arb], pieces: Sequence[Piece], inside: Callable[[arb], float]
) -> tuple[float, list[arb]]:
    """An instant as a float with the states then; where it is none, a float in the step beside it, and both states."""
    time = float(instant.mid())
    if instant == arb(time) or not pieces:
        return time, box
    time = inside(instant)
    tube = pieces[0].at(interval(arb(time), instant))
    return time, [a.union(b) for a, b in zip(box, tube, strict=True)]


def _plain(system: System) -> None:
    """SymPy has simplified under the declarations of states and time, which nothing makes a run obey."""
    for symbol in (system.time, *system.state):
        if any(getattr(symbol, f"is_{kind}") is not None for kind in ("positive", "negative", "zero", "rational")):
            raise InputError(
                f"{symbol}: declare the time and the states of a run that is enclosed as real, and no more"
            )


def _balls(values: Mapping[str, Any]) -> list[arb]:
    return [
        interval(*map(ball_from, value)) if isinstance(value, tuple) else ball_from(value) for value in values.values()
    ]  # fmt: skip


def _width(value: Any) -> arb:
    exact = _exact(value if not isinstance(value, float) else repr(value), "width")
    with flint.ctx.workprec(_BITS):
        ball = ball_from(exact)
        if not ball > 0:
            raise InputError(f"width: must be positive, got {value}")
        return ball


def _exact(value: Any, where: str) -> Any:
    if isinstance(value, tuple):
        if len(value) != 2:
            raise InputError(f"{where}: expected a number or (low, high), got {value!r}")
        low, high = (_exact(entry, where) for entry in value)
        if not sp.N(low) <= sp.N(high):
            raise InputError(f"{where}: low must not be above high, got {low} to {high}")
        return low, high
    if isinstance(value, str):
        value = parse(value, where=where)
    if isinstance(value, bool | float) or not isinstance(value, int | sp.Expr):
        raise InputError(f'{where}: {value!r} is not exact; give an integer, a fraction, or text such as "0.1"')
    exact = sp.sympify(value)
    if exact.free_symbols or exact.atoms(sp.Float):
        raise InputError(f"{where}: {value} is not an exact number")
    try:
        ball_from(exact)
    except Undefined as error:
        raise InputError(f"{where}: {value}: {error}") from None
    return exact


def _asked(
    target: Any, seeker: str | None, frame: str, initial: Any, span: Any, until: Any, model: str
) -> tuple[System, dict[str, Any], sp.Expr, sp.Expr]:
    if isinstance(target, System):
        return _of_system(target, initial, span)
    if not isinstance(target, Problem | str):
        raise InputError(f"enclose: expected a problem, a system or an example's name, got {type(target).__name__}")
    if span is not None:
        raise InputError("span: a problem has its own; use until= for another end")
    problem = example(target) if isinstance(target, str) else target
    check_word("model", model, MODELS)
    name = seeker or problem.default_seeker
    derive = {"closed loop": problem.closed_loop, "reduced model": problem.reduced_model, "average": problem.averaged}
    system = derive[model](name, frame)
    letters, start = problem.states, problem.initial
    own = dict(zip((symbol.name for symbol in problem.variables), start.x, strict=True))
    own |= {letters.heading.name: start.theta, letters.angular_velocity.name: start.u2}
    own |= _given(initial or {}, [*own, letters.filter.name])
    if letters.filter.name not in own:
        own[letters.filter.name] = _measured(problem, own)
    first, last = _times(problem, name, frame, until)
    return system, {symbol.name: own[symbol.name] for symbol in system.state}, first, last


def _measured(problem: Problem, own: Mapping[str, Any]) -> Any:
    """Where the filter starts: at the field as it is measured, unless the problem says otherwise."""
    position = [own[symbol.name] for symbol in problem.variables]
    if problem.initial.z is not None:
        return problem.initial.z
    if any(isinstance(value, tuple) for value in position):
        raise InputError("initial: with an interval for a position, give z too: it would depend on it")
    return problem.field.value(tuple(position))


def _times(problem: Problem, seeker: str, frame: str, until: Any) -> tuple[sp.Expr, sp.Expr]:
    tuning, clock_ = problem.tuning, problem.seeker_clock(seeker)
    end = tuning.t0 + tuning.T if until is None else _exact(until, "until")
    if not sp.N(end) > sp.N(tuning.t0):
        raise InputError(f"until: must be after the start t0 = {tuning.t0}, got {end}")
    values = dict(problem.values)
    horizon = clock_.horizon if clock_.horizon is sp.oo else sp.sympify(clock_.horizon).subs(values)
    if horizon is not sp.oo and not sp.N(end) < sp.N(tuning.t0 + horizon):
        raise InputError("until: the gain is not clipped and infinite at T, where no run gets; give an earlier end")
    if frame == "t":
        return tuning.t0, end
    first, last = (clock_.to_tau.subs(values).subs(clock_.t, instant) for instant in (tuning.t0, end))
    return sp.simplify(first), sp.simplify(last)


def _of_system(system: System, initial: Any, span: Any) -> tuple[System, dict[str, Any], sp.Expr, sp.Expr]:
    names = [symbol.name for symbol in system.state]
    if initial is None or span is None:
        raise InputError(f"{system.name}: a system needs initial= (states {', '.join(names)}) and span=(start, end)")
    if not isinstance(initial, Mapping):
        if len(initial) != len(names):
            raise InputError(f"initial: {len(initial)} numbers for {len(names)} states ({', '.join(names)})")
        initial = dict(zip(names, initial, strict=True))
    given = _given(initial, names)
    if absent := [name for name in names if name not in given]:
        raise InputError(f"initial: no value for {', '.join(absent)}")
    if len(span) != 2:
        raise InputError("span: expected (start, end)")
    start, end = (_exact(value, "span") for value in span)
    if not sp.N(start) < sp.N(end):
        raise InputError(f"span: must end after it starts, got {start} to {end}")
    return system, {name: given[name] for name in names}, start, end


def _given(initial: Mapping[Any, Any], names: Sequence[str]) -> dict[str, Any]:
    given = {getattr(key, "name", key): value for key, value in initial.items()}
    for name in given:
        if name not in names:
            raise InputError(f"initial: {name!r} is not one of {', '.join(names)}")
    return {name: _exact(value, f"initial.{name}") for name, value in given.items()}
