"""The pipeline: from the closed loop in t to the averaged system in t, every stage computed from the one before.

Nothing here is transcribed from the paper except the plant and the feedback law themselves.
"""

from __future__ import annotations

import sympy as sp

from ptproof.averaging import average, split_dithers
from ptproof.problem.seekers import Letters, asymptotic_seeker, prescribed_time_seeker
from ptproof.transforms import (
    change_variable,
    contract,
    dilate,
    prescribed_time_clock,
    scale_time,
    solve_state,
    split,
)

from .notation import F, T, f, k, mu, omega, p, t, t0, tau, tau_fast, theta, u2, x1, x2, y_tilde, z

letters = Letters((x1, x2), theta, z, u2)
clock = prescribed_time_clock(t, tau, start=t0, horizon=T)

closed_loop_t = prescribed_time_seeker(F, f, k=k, omega=omega, mu=mu, clock=clock, states=letters)
closed_loop_tau = dilate(closed_loop_t, clock)
with_p = change_variable(closed_loop_tau, theta, p, theta + k * z, p - k * z)
reduced_coordinates = solve_state(with_p, p, omega * tau)
fast_time = scale_time(reduced_coordinates, mu, tau_fast)

slow_fast = split(reduced_coordinates, [z], mu)
boundary_layer = slow_fast.boundary_layer([y_tilde], tau_fast)
reduced_model = slow_fast.reduced_model()
reduced_model_fast = scale_time(reduced_model, mu, tau_fast)

dithered = split_dithers(reduced_model, omega)
averaged_tau = average(dithered)
averaged_t = contract(averaged_tau, clock)

asymptotic = asymptotic_seeker(F, f, k=k, omega=omega, mu=mu, time=t, states=letters)

gradient_F = sp.ImmutableDenseMatrix([sp.diff(F, x1), sp.diff(F, x2)])
