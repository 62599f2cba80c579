"""A claim that was shown and yet hit by the attacker stands at the head of the report."""

from dataclasses import replace

from ptproof.proof.result import Verification
from ptproof.proof.run import conclude
from ptproof.proof.verdict import Evidence, Verdict
from ptproof.report.compose import compose


def test_a_hit_is_the_first_note(derivation, verification):
    hit = Evidence("attack", Verdict.REFUTED, "z3 shows what is false: the relation fails: x**2 > 0 at x = 0")
    evidence = {}
    for result in verification.results:
        own = replace(result.evidence[0], content=result.claim.content)
        evidence[result.claim.id] = replace(own, besides=(hit,)) if result.claim.id == "a/corrected" else own
    report = compose(Verification(conclude(derivation.claims, evidence), 1.0), derivation, notes=["another"])
    assert "a/corrected" in report.notes[0]
    assert "contradicts itself" in report.notes[0]
    assert report.notes[1] == "another"
    assert "a/corrected" in {claim.ref.id for claim in report.unexpected}
