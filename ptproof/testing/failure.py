"""Failing the way an assertion fails: a message for a person, and a traceback that ends in the user's line.

pytest leaves out frames that hold ``__tracebackhide__``, unittest leaves out modules that hold ``__unittest``, and a
notebook asks the exception for its traceback. A plain script has no such word, so the first failure puts a hook before
``sys.excepthook`` that cuts the same frames off, from the exceptions raised here and from no others.
"""

from __future__ import annotations

import functools
import sys
import traceback
from collections.abc import Callable
from types import TracebackType
from typing import ParamSpec, TypeVar

from ptproof.errors import InputError
from ptproof.reading.limits import OutOfTime, within

__unittest = True
SECONDS = 60.0  # of an assertion, where nothing else is said
Arguments = ParamSpec("Arguments")
Answer = TypeVar("Answer")
_MARK = "_ptproof_ends_in_the_users_line"


def assertion(check: Callable[Arguments, str | None]) -> Callable[Arguments, None]:
    """Make a check, which returns None or why it fails, a function that raises ``AssertionError`` with that text."""

    @functools.wraps(check)
    def assert_it(*args: Arguments.args, **kwargs: Arguments.kwargs) -> None:
        __tracebackhide__ = True
        error: Exception
        try:
            reason = check(*args, **kwargs)
            if reason is None:
                return
            error = AssertionError(reason)
        except (InputError, TypeError) as bad_use:
            if isinstance(bad_use, TypeError) and not _raised_here(bad_use):
                raise
            error = bad_use.with_traceback(None)
        error.__dict__.update({_MARK: True, "_render_traceback_": functools.partial(_render, error)})
        if not hasattr(sys.excepthook, _MARK):
            sys.excepthook = _shortening(sys.excepthook)
        raise error from None

    assert_it.__annotations__ = {**check.__annotations__, "return": None}
    return assert_it


def in_time(seconds: float, what: str, work: Callable[[], Answer], spare: float = 0.0) -> Answer | str:
    """What the work gives, or that there is no answer in time; it may take ``spare`` seconds more than is said."""
    try:
        return within(seconds + spare, work)
    except OutOfTime:
        return f"{what} could not be decided: no answer in {seconds:g} s"


def _raised_here(error: TypeError) -> bool:
    """Whether it is about the arguments of an assertion; one from the engines below keeps its whole traceback."""
    *_, (last, _) = traceback.walk_tb(error.__traceback__)
    return str(last.f_globals.get("__name__")).startswith("ptproof.testing")


Hook = Callable[[type[BaseException], BaseException, TracebackType | None], object]


def _shortening(show: Hook) -> Hook:
    @functools.wraps(show)
    def shorten(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> object:
        if getattr(error, _MARK, False):
            trace = users_part(trace)
            error = error.with_traceback(trace)
        return show(kind, error, trace)

    setattr(shorten, _MARK, True)
    return shorten


def _render(error: Exception) -> list[str]:
    """What a notebook shows: its own form of the traceback, without the frames at the end that ask to be hidden."""
    trace = users_part(error.__traceback__)
    notebook = sys.modules.get("IPython")
    shell = notebook.get_ipython() if notebook is not None else None
    if shell is None:
        return "".join(traceback.format_exception(type(error), error, trace)).splitlines()
    shown: list[str] = shell.InteractiveTB.structured_traceback(type(error), error, trace)
    return shown


def users_part(trace: TracebackType | None) -> TracebackType | None:
    """The traceback without the frames at its end that ask to be hidden; all of it if nothing else is there."""
    steps = []
    step = trace
    while step is not None:
        steps.append(step)
        step = step.tb_next
    while steps and steps[-1].tb_frame.f_locals.get("__tracebackhide__"):
        steps.pop()
    shortened: TracebackType | None = None
    for step in reversed(steps):
        shortened = TracebackType(shortened, step.tb_frame, step.tb_lasti, step.tb_lineno)
    return shortened or trace
