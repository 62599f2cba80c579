"""Python's garbage collection, left out for a while."""

from __future__ import annotations

import gc

import pytest

from ptproof.reading.garbage import collecting


def test_it_is_left_out_and_taken_up_again_within() -> None:
    seen = []
    with collecting(False):
        seen.append(gc.isenabled())
        with collecting(True):
            seen.append(gc.isenabled())
        seen.append(gc.isenabled())
    assert seen == [False, True, False]
    assert gc.isenabled()


def test_after_an_error_it_is_as_before() -> None:
    with pytest.raises(ZeroDivisionError), collecting(False):
        raise ZeroDivisionError
    assert gc.isenabled()
