"""SciPy's LSODA, a peer."""

from ptproof.simulation.scipy_methods import SciPy

ENGINE = SciPy("LSODA")
