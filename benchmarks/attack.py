"""Everything that can be attacked, attacked: ``python -m benchmarks.attack [SEED]``.

The claims of the derivation that ships, the certified constants, bounds and gains of the paper's examples, every clock,
and averages. It ends with status 1 at the first hit, which is an error of ptproof.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator

import sympy as sp

from ptproof.averaging import derive
from ptproof.averaging.attack import attack_average
from ptproof.certify import certify_field
from ptproof.certify.attack import attack_certificate
from ptproof.gains import study
from ptproof.gains.attack import attack_answer, attack_curve
from ptproof.problem import example
from ptproof.problem.model import TAU, TIME
from ptproof.proof.attack import WrongPromise, attack
from ptproof.proof.load import load
from ptproof.proof.verdict import Verdict
from ptproof.system import DitherSystem
from ptproof.transforms.clocks import capped, named_clock
from ptproof.transforms.clocks.attack import unshaken
from ptproof.transforms.clocks.named import CLOCKS

EXAMPLES = ("vanishing", "nonvanishing", "saturated")


def claims(seed: int) -> Iterator[int]:
    """Points at which each claim that its author expects to be proved was attacked in vain."""
    for claim in load().claims:
        if claim.expected is Verdict.PROVED:
            done = attack(claim.goal(), seed=seed)
            if done.hit is not None:
                raise WrongPromise(f"the claim {claim.id} was to be proved", str(done.hit))
            yield done.points


def fields(seed: int) -> Iterator[int]:
    """Places at which the certified constants of each example's field were attacked in vain."""
    for name in EXAMPLES:
        radius = 2 if name == "nonvanishing" else None
        yield attack_certificate(certify_field(example(name).field, radius=radius), seed=seed, rays=12)


def bounds(seed: int) -> Iterator[int]:
    """Instants, and promises, at which bounds and gains of each example held in integrations."""
    for name in EXAMPLES:
        found = study(example(name))
        yield attack_curve(found.problem, found.curve, seed=seed)
        yield 0 if found.answer is None else attack_answer(found.answer)


def clocks(seed: int) -> Iterator[int]:
    """Points at which each clock, with and without a cap, was attacked in vain."""
    for name in CLOCKS:
        exponent = sp.Rational(3, 2) if name == "power" else None
        clock = named_clock(name, TIME, TAU, start=sp.Integer(1), horizon=sp.Rational(7, 3), exponent=exponent)
        yield unshaken(clock) + unshaken(capped(clock, sp.Rational(3, 10)))


def averages(seed: int) -> Iterator[int]:
    """Points at which averages of seekers with several dithers were attacked in vain."""
    tau, theta, x, y = sp.symbols("tau theta x y", real=True)
    omega, k = sp.symbols("omega k", positive=True)
    F = sp.Function("F", real=True)(x, y)
    vectors = ((sp.cos(k * F), -sp.sin(k * F)), (sp.sin(k * F), sp.cos(k * F)), (x * y, F))
    for third in (sp.cos(2 * theta), sp.sin(theta + 1)):
        dithers = (sp.cos(theta), sp.sin(theta), third)
        yield attack_average(derive(DitherSystem(tau, theta, omega, (x, y), (-x, 0), vectors, dithers)))


ROOMS: dict[str, Callable[[int], Iterator[int]]] = {
    "claims": claims, "fields": fields, "bounds": bounds, "clocks": clocks, "averages": averages,
}  # fmt: skip


def main() -> int:
    """Attack all of it and say how often; 1 where something is hit."""
    seed = int(sys.argv[1]) if len(sys.argv) > 1 else 0
    for name, room in ROOMS.items():
        start = time.process_time()
        try:
            counts = list(room(seed))
        except WrongPromise as error:
            print(error)
            return 1
        print(f"{name:<9} {len(counts):>4} attacked, {sum(counts):>6} times, {time.process_time() - start:6.1f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
