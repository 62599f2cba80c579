"""The same questions have the same answers in every process: under another hash seed, sets run in another order."""

from __future__ import annotations

import os
import random
import subprocess
import sys
from pathlib import Path
from typing import Any

from tests.fuzz import sizes

ROOT = Path(__file__).resolve().parents[2]
FIRST = 12


def answers(seed: int, count: int) -> list[str]:
    """What the engines say about so many questions that depend on the seed only."""
    import sympy as sp

    from ptproof.proof.engines.exact import resolve
    from ptproof.proof.engines.limits import limit_of
    from ptproof.proof.powers import split_powers
    from ptproof.proof.signs import sign_of, vanishes
    from tests.fuzz import trees

    generator = random.Random(seed)
    found = []
    for _ in range(count):
        expression = _random(generator, sp, trees, 4)
        try:
            with sizes.within(3.0):
                found += [
                    str(expression), str(sign_of(expression)), str(vanishes(expression)),
                    str(split_powers(expression)),
                    str(limit_of(expression, trees.x, sp.S.Zero, "+")), str(resolve(expression,
                    {trees.x: trees.p + trees.q})),
                ]  # fmt: skip
        except sizes.TooSlow:
            found.append("too slow")
    return found


def _random(generator: random.Random, sp: Any, trees: Any, depth: int) -> Any:
    if depth == 0 or generator.random() < 0.2:
        return generator.choice([trees.x, trees.p, trees.q, trees.y, trees.m, sp.Integer(2), sp.Rational(1, 3), sp.pi])
    left, right = (_random(generator, sp, trees, depth - 1) for _ in range(2))
    made = generator.choice(
        [lambda: left + right, lambda: left * right, lambda: left - right, lambda: left**2 / (1 + right**2),
        lambda: sp.sin(left) * right,
         lambda: sp.sqrt(left**2 + right**2), lambda: sp.Max(left, right), lambda: sp.exp(left),
         lambda: sp.Abs(left + right),
         lambda: trees.F(left) + sp.cos(right), lambda: (left * right) ** sp.Rational(1, 2)]
    )()  # fmt: skip
    return made if trees.is_plain(made) else left


def test_answers_do_not_depend_on_the_hash_seed() -> None:
    count = FIRST if sizes.chosen is None else sizes.chosen.examples
    seed = 0 if sizes.chosen is None else sizes.chosen.seed
    program = f"from tests.fuzz.test_hash_seed import answers\nprint('\\n'.join(answers({seed}, {count})))"
    outputs = []
    for hash_seed in ("1", "77"):
        environment = {**os.environ, "PYTHONHASHSEED": hash_seed, "PYTHONPATH": str(ROOT)}
        done = subprocess.run(
            [sys.executable, "-c", program], env=environment, capture_output=True, text=True, check=True
        )
        outputs.append(done.stdout.splitlines())
    assert len(outputs[0]) >= count
    # A question that ran out of time in one of the two says nothing.
    if not any("too slow" in output for output in outputs):
        assert outputs[0] == outputs[1]
