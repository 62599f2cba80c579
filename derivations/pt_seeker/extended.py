"""The closed loop with the drift's factor as a state: one autonomous system for all initial times and headings.

The drift E∇F/(1 + (τ − t₀)/T)² is ρ⁴E∇F for ρ = (1 + (τ − t₀)/T)^(−1/2), and ρ solves dρ/dτ = −ρ³/(2T). With ρ as a
state neither t₀ nor a pole before t₀ is left, and what is left of time are the dithers.
"""

from __future__ import annotations

import sympy as sp

from ptproof.averaging import average, split_dithers
from ptproof.problem.drift import gradient_drift
from ptproof.problem.seekers import prescribed_time_seeker
from ptproof.system import System
from ptproof.transforms import change_variable, dilate, scale_time, solve_state, split

from .chain import clock, letters
from .notation import E, F, T, k, mu, omega, p, position, t0, tau, theta, x1, x2, y_tilde, z

rho = sp.Symbol("rho", real=True)
sigma = sp.Symbol("sigma", real=True)  # the slow time of this system: its dithers have the phase ωσ
sigma_fast = sp.Symbol("sigma_f", real=True)  # σ/μ

pushed = gradient_drift(E.tolist(), F, position).rate

# The seeker with this drift, started with any heading and any state of the filter, and written in τ as in Step 1.
theta0, z0 = sp.symbols("theta0 z0", real=True)
seeker = prescribed_time_seeker(F, pushed, k=k, omega=omega, mu=mu, clock=clock, states=letters)
with_p = change_variable(dilate(seeker, clock), theta, p, theta + k * z, p - k * z)
p_solution = omega * (tau - t0) + theta0 + k * z0
in_tau = solve_state(with_p, p, p_solution)

system = System(
    sigma,
    (x1, x2, rho, z),
    (
        rho**4 * pushed[0] + sp.sqrt(omega) * sp.cos(omega * sigma - k * z),
        rho**4 * pushed[1] + sp.sqrt(omega) * sp.sin(omega * sigma - k * z),
        -(rho**3) / (2 * T),
        (F - z) / mu,
    ),
    name="extended closed loop",
)
fast_time = scale_time(system, mu, sigma_fast)
slow_fast = split(system, [z], mu)
boundary_layer = slow_fast.boundary_layer([y_tilde], sigma_fast)
dithered = split_dithers(slow_fast.reduced_model(), omega)
averaged = average(dithered)
# The dithered fields while z is still a state of its own.
dithered_with_z = split_dithers(System(sigma, slow_fast.slow_state, slow_fast.slow_rhs, name="slow states"), omega)
