"""A seeking problem as data: field, drift, seeker and initial state, read exactly from TOML, and its closed loops."""

from ptproof.problem.loops import FRAMES, SEEKERS, closed_loop, parameters
from ptproof.problem.model import Initial, Problem, Saturation, Tuning
from ptproof.problem.models import averaged_system, reduced_model
from ptproof.problem.reading import EXAMPLES, example, load

__all__ = [
    "EXAMPLES",
    "FRAMES",
    "SEEKERS",
    "Initial",
    "Problem",
    "Saturation",
    "Tuning",
    "averaged_system",
    "closed_loop",
    "example",
    "load",
    "parameters",
    "reduced_model",
]
