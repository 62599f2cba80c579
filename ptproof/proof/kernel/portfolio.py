"""The tactics that are tried on a proposition: fixed ones, chosen by what the claim looks like and by nothing else."""

from __future__ import annotations

from ptproof.proof.claim import Claim


def script(claim: Claim) -> str:
    """The tactics, as one sentence for Coq."""
    return f"unfold claim; ptproof"
