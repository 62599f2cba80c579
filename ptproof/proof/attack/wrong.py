"""What is raised where the attacker contradicts something that ptproof has promised."""

from __future__ import annotations

from ptproof.proof.attack.attacker import Attack, attack
from ptproof.proof.claim import Goal


class WrongPromise(RuntimeError):
    """ptproof promised something that does not hold: an error of ptproof, whatever was asked of it."""

    def __init__(self, promise: str, reason: str) -> None:
        super().__init__(f"ptproof is wrong here: {promise}, but {reason}. Please report this with what was asked.")
        self.promise = promise
        self.reason = reason

    def __reduce__(self) -> tuple[type[WrongPromise], tuple[str, str]]:
        return WrongPromise, (self.promise, self.reason)


def insist(promise: str, goal: Goal, *, points: int = 20, seconds: float = 1.0) -> Attack:
    """Attack what has been promised; raises :class:`WrongPromise` where it is hit."""
    done = attack(goal, points=points, seconds=seconds)
    if done.hit is not None:
        raise WrongPromise(promise, str(done.hit))
    return done
