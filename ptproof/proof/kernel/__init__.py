"""A second opinion from outside: a claim restated for Coq, and what Coq's kernel says of it.

The proposition is made from the statement, the assumptions and the declarations; what has to be defined is part of it,
since 1/0 is 0 for Coq. Tactics look for a proof, the kernel checks what they found, and the axioms that it rests on are
read from what the kernel prints. Of the claim's own proof nothing is believed. A hint is which claims it puts to use at
which values: Coq may show that the claim follows from these as lemmas, which counts once it has confirmed them all.
"""

from ptproof.proof.kernel.check import check
from ptproof.proof.kernel.coq import missing
from ptproof.proof.kernel.remembered import Confirmation

__all__ = ["Confirmation", "check", "missing"]
