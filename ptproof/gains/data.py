"""What an engineer knows: the constants of the field, the drift, and the tuning; checked when put together."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from functools import cached_property

import sympy as sp

from ptproof.errors import InputError
from ptproof.gains.horizon import Horizon, unit_clock
from ptproof.gains.numbers import NotApplicable, short, sign
from ptproof.problem.field import FieldBounds

_LARGEST_KAPPA = 1000
_POSITIVE = ("k", "T", "nu_min", "V0", "x0_norm", "residual", "omega", "mu", "exponent", "radius")
_ANY_SIGN = ("t0", "tau_star")
_NUMBERS = (*_POSITIVE, "drift_norm", "drift_bound", "drift_bound_later", "filter_error", *_ANY_SIGN)


@dataclass(frozen=True)
class GainData:
    """The data of a question about gains; whatever is unknown is None.

    Attributes
    ----------
    bounds
        a₁, a₂, b₁, b₂ and κ of the field (eq:assumption2, eq:assumption3).
    k, T, nu_min
        Gain, prescribed time, and ν_min ∈ (0, 1] from which on the clock's rate is constant (eq:kt).
    clock, exponent
        The clock whose rate is the seeker's time-varying gain, by name, and its m where that is ``"power"``.
    drift_matrix, drift_norm
        E (n × n) of a drift E∇F, and its largest singular value ‖E‖; the norm follows from the matrix.
    drift_bound
        sup d of a bounded drift ‖f‖ ≤ d: for all time, or up to t₀ + T where ``drift_until_end`` says so. [length/time]
    drift_until_end, drift_bound_later
        Whether ``drift_bound`` speaks of [t₀, t₀ + T] alone, and a bound for all time where one is known.
    V0, x0_norm
        V = F(x*) − F at the start, and ‖x₀ − x*‖; V₀ ≤ a₁‖x₀ − x*‖^(2κ) where only the distance is known.
    t0, tau_star
        The start, and a stretched time τ* > t₀.
    residual
        A distance to the source that is wanted at t₀ + T. Bounds are of the average; the vehicle circles around it.
    omega, mu
        The seeker's frequency and filter constant, for the peak inputs.
    filter_error
        |y − z| at the start: 0 where the filter starts at the measured field.
    radius
        Of the ball around the source on which the constants hold; None for the whole space. Thresholds then are such
        that the average stays in it up to t₀ + T; that it does is the caller's to show for all other bounds.

    Raises
    ------
    InputError
        For numbers that contradict each other or the paper's assumptions, with the reason.

    Examples
    --------
    >>> data = GainData(FieldBounds(1, 2, 1, 1, 2), k=1, T=1, nu_min=sp.Rational(1, 10), clock="power", exponent=2)
    >>> data.horizon.cap, data.horizon.stretched_end
    (1000, 299/2)
    """

    bounds: FieldBounds
    k: sp.Expr | None = None
    T: sp.Expr | None = None
    nu_min: sp.Expr | None = None
    drift_norm: sp.Expr | None = None
    drift_matrix: sp.ImmutableDenseMatrix | None = None
    drift_bound: sp.Expr | None = None
    V0: sp.Expr | None = None
    x0_norm: sp.Expr | None = None
    t0: sp.Expr = sp.S.Zero
    tau_star: sp.Expr | None = None
    residual: sp.Expr | None = None
    omega: sp.Expr | None = None
    mu: sp.Expr | None = None
    clock: str = "paper"
    exponent: sp.Expr | None = None
    radius: sp.Expr | None = None
    drift_until_end: bool = False
    drift_bound_later: sp.Expr | None = None
    filter_error: sp.Expr = sp.S.Zero

    def __post_init__(self) -> None:
        if not isinstance(self.bounds.kappa, sp.Integer):
            raise InputError("kappa must be a number here; symbolic formulas are in ptproof.comparison")
        if self.bounds.kappa > _LARGEST_KAPPA:
            raise InputError(f"kappa must be at most {_LARGEST_KAPPA}, got {short(self.bounds.kappa)}")
        for name in (name for name in _NUMBERS if getattr(self, name) is not None):
            value = _number(getattr(self, name), name)
            least, words = (1, "be positive") if name in _POSITIVE else (0, "not be negative")
            if name not in _ANY_SIGN and sign(value) < least:
                raise InputError(f"{name} must {words}, got {short(value)}")
            object.__setattr__(self, name, value)
        unit_clock(self.clock, self.exponent)  # which refuses what is no clock
        if self.nu_min is not None and sign(self.nu_min - 1) > 0:
            raise InputError(f"nu_min must lie in (0, 1], got {short(self.nu_min)}")
        if self.tau_star is not None and sign(self.tau_star - self.t0) <= 0:
            raise InputError(f"tau_star must be later than t0 = {self.t0}, got {short(self.tau_star)}")
        if self.drift_matrix is not None:
            matrix = sp.ImmutableDenseMatrix(self.drift_matrix)
            if matrix.rows != matrix.cols:
                raise InputError(f"the drift matrix must be square, not {matrix.rows} × {matrix.cols}")
            object.__setattr__(self, "drift_matrix", matrix)
            norm = largest_singular_value(matrix)
            if self.drift_norm is None:
                object.__setattr__(self, "drift_norm", norm)
            elif sign(self.drift_norm - norm) < 0:
                raise InputError(f"drift_norm = {self.drift_norm} is less than the norm {short(norm)} of the matrix")
        if self.V0 is not None and self.x0_norm is not None:
            low, high = (a * self.x0_norm ** (2 * self.bounds.kappa) for a in (self.bounds.a2, self.bounds.a1))
            if sign(self.V0 - high) > 0 or sign(self.V0 - low) < 0:
                raise InputError(
                    f"V0 = {short(self.V0)} contradicts x0_norm: V0 must lie in [a2, a1]·x0_norm^(2κ) "
                    f"= [{float(low):.6g}, {float(high):.6g}]"
                )

    def known(self, *names: str) -> tuple[sp.Expr, ...]:
        """The values of these fields; :class:`NotApplicable` names those that are None."""
        if missing := [name for name in names if getattr(self, name) is None]:
            raise NotApplicable(f"needs {' and '.join(missing)}")
        return tuple(getattr(self, name) for name in names)

    @property
    def numbers(self) -> Mapping[str, sp.Expr]:
        """The numbers that are known, by their names, with the constants of the field."""
        known = {name: getattr(self, name) for name in _NUMBERS if getattr(self, name) is not None}
        return known | {item.name: getattr(self.bounds, item.name) for item in fields(self.bounds)}

    @cached_property
    def horizon(self) -> Horizon:
        """The clock through the prescribed time, with its cap where ν_min is known."""
        return replace(self.unit, T=self.known("T")[0])

    @property
    def unit(self) -> Horizon:
        """The same clock through the prescribed time 1; its rates are those of any other."""
        return Horizon(sp.S.One, self.nu_min, unit_clock(self.clock, self.exponent))

    @property
    def impossible(self) -> str | None:
        """Why no field on the whole space has these constants, or None.

        Along a ray F(x*) − F is at most the integral of b₂r^(2κ−1), so a₂ ≤ b₂/(2κ); along the steepest ascent, which
        is at least as long as the distance, it is at least that of b₁r^(2κ−1), so a₁ ≥ b₁/(2κ).
        """
        bounds, twice = self.bounds, 2 * self.bounds.kappa
        if sign(bounds.a2 - bounds.b2 / twice) > 0:
            return "no field has these constants: a2 must not exceed b2/(2*kappa)"
        if sign(bounds.b1 / twice - bounds.a1) > 0:
            return "no field on the whole space has these constants: b1/(2*kappa) must not exceed a1"
        return None

    @property
    def norm(self) -> sp.Expr:
        """‖E‖, 0 without a gradient drift."""
        return sp.S.Zero if self.drift_norm is None else self.drift_norm

    @cached_property
    def push(self) -> sp.Expr:
        """The least m with −∇Fᵀ E ∇F ≤ m‖∇F‖²: −λ_min((E + Eᵀ)/2) for a known matrix, else ‖E‖.

        It is negative for a drift that always helps.
        """
        return self.norm if self.drift_matrix is None else -smallest_eigenvalue(symmetric_part(self.drift_matrix))

    @property
    def level(self) -> sp.Expr | None:
        """a₂·radius^(2κ): while V is at most that, the position is where the constants hold; None for everywhere."""
        return None if self.radius is None else self.bounds.a2 * self.radius ** (2 * self.bounds.kappa)

    @property
    def everlasting_drift(self) -> sp.Expr:
        """A bound of ‖f‖ for all time."""
        if self.drift_bound_later is not None:
            return self.drift_bound_later
        if self.drift_until_end:
            raise NotApplicable("the drift is enclosed up to t0 + T only; give a drift_bound that holds for all time")
        return self.known("drift_bound")[0]

    @property
    def start_value(self) -> sp.Expr:
        """V₀, or its upper bound a₁‖x₀ − x*‖^(2κ)."""
        if self.V0 is not None:
            return self.V0
        if self.x0_norm is None:
            raise NotApplicable("needs V0 or x0_norm")
        return self.bounds.a1 * self.x0_norm ** (2 * self.bounds.kappa)


def _number(value: object, name: str) -> sp.Expr:
    if isinstance(value, float | bool):
        raise InputError(f"{name} must be exact, not {value!r}: give an integer, a fraction or decimal text")
    number = sp.sympify(value)
    if not isinstance(number, sp.Expr) or not number.is_number or number.has(sp.Float):
        raise InputError(f"{name} must be an exact number, got {short(number)}")
    if number.is_real is not True or not number.is_finite:
        raise InputError(f"{name} must be a finite real number, got {short(number)}")
    return number


def symmetric_part(matrix: sp.ImmutableDenseMatrix) -> sp.ImmutableDenseMatrix:
    """(E + Eᵀ)/2."""
    return sp.ImmutableDenseMatrix((matrix + matrix.T) / 2)


def smallest_eigenvalue(matrix: sp.ImmutableDenseMatrix) -> sp.Expr:
    """The exact smallest eigenvalue of a symmetric matrix (n × n; entries rational, or n ≤ 2, or diagonal)."""
    return _eigenvalues(matrix)[0]


def largest_singular_value(matrix: sp.ImmutableDenseMatrix) -> sp.Expr:
    """‖E‖ = √λ_max(EᵀE), exact."""
    if matrix.is_diagonal():
        return sp.Max(*map(sp.Abs, matrix.diagonal()))
    return sp.sqrt(_eigenvalues(sp.ImmutableDenseMatrix(matrix.T * matrix))[-1])


def _eigenvalues(matrix: sp.ImmutableDenseMatrix) -> list[sp.Expr]:
    """Those of a symmetric matrix, in order; of a diagonal one only the smallest and the largest."""
    if matrix.is_diagonal():
        return [sp.Min(*matrix.diagonal()), sp.Max(*matrix.diagonal())]
    if matrix.rows == 2:
        mean, gap = matrix.trace() / 2, (matrix[0, 0] - matrix[1, 1]) / 2
        root = sp.sqrt(gap**2 + matrix[0, 1] ** 2)
        return [mean - root, mean + root]
    if all(entry.is_Rational for entry in matrix):
        return list(matrix.charpoly().real_roots())
    raise InputError(
        f"the eigenvalues of an irrational {matrix.rows} × {matrix.rows} matrix are not computed; give the drift's norm"
    )
