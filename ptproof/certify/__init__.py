"""Certified constants of a signal field: the best a₁, a₂, b₁, b₂ on a ball, an annulus or the whole space."""

from ptproof.certify.certificate import FieldCertificate, FieldWitness, Range
from ptproof.certify.domain import Domain
from ptproof.certify.search import certify_field

__all__ = ["Domain", "FieldCertificate", "FieldWitness", "Range", "certify_field"]
