"""SciPy's DOP853, a peer."""

from ptproof.simulation.scipy_methods import SciPy

ENGINE = SciPy("DOP853")
