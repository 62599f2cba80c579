"""Section 6.4: what the clipped gain guarantees on the average under a bounded drift, for κ = 1.

V(s) and ‖∇F‖ are taken along the averaged trajectory. After the clip the drift is not beaten any more: what is left is
a level that does not depend on the start.
"""

from __future__ import annotations

import sympy as sp

from ptproof.proof import (
    Evidence,
    ForAll,
    Goal,
    claim,
    comparison,
    eq,
    exp_monotone,
    ge,
    gt,
    instances,
    le,
    limits,
    reals,
    specialise,
)

from .notation import F, F_source, T, c, d, f, k, nu, t, t0
from .section6c_feasibility import lowest
from .section6d_clipped import (
    ONE,
    G_t,
    V_t,
    average_with_gain,
    below_one,
    clipped,
    final,
    gain_after,
    gain_before,
    s,
    slope,
    switch,
    total,
    with_gain,
)
from .notation import C
from .section7_inputs import G  # noqa

SECTION = "6.4 Discussion: what the clipped gain guarantees"
