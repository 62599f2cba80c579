"""SciPy's Radau, a peer."""

from ptproof.simulation.scipy_methods import SciPy

ENGINE = SciPy("Radau")
