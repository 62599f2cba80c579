"""A right-hand side written with sin and cos of (frequency · time + g(x)) becomes drift, fields and dithers.

This is the step from eq:reduced_model_tau to eq:reduced_model_tau_2.
"""

from __future__ import annotations

import sympy as sp

from ptproof.averaging.brackets import tidy
from ptproof.averaging.quasipolynomial import read
from ptproof.averaging.refusal import AveragingRefused, AveragingUndecided
from ptproof.system import DitherSystem, System


def split_dithers(
    system: System, omega: sp.Symbol, phase: sp.Symbol | None = None, *, name: str | None = None
) -> DitherSystem:
    """Angle addition: write a system as drift + √ω Σ field · cos(mθ) or sin(mθ), with θ = ω·time.

    Parameters
    ----------
    system
        Its right-hand side contains the frequency only in √ω and in sines and cosines of m·ω·time + g, with
        rational m, and g free of the frequency (powers and products of these are expanded).
    omega, phase
        The frequency, declared positive, and the symbol θ for ω·time (a real ``theta`` where left out).

    Returns
    -------
    DitherSystem
        With the dithers cos(mθ), sin(mθ) in the order of m, only those whose field is not zero, and their least
        common period. The difference between its ``to_system`` and ``system`` has the normal form 0, exactly.

    Raises
    ------
    AveragingRefused
        If a fast term does not have the factor √ω, or the factor stands with no dither.
    AveragingUndecided
        If what was read is not shown to be the right-hand side again.

    Examples
    --------
    >>> tau, x = sp.symbols("tau x", real=True)
    >>> omega, F = sp.Symbol("omega", positive=True), sp.Function("F", real=True)(x)
    >>> split_dithers(System(tau, (x,), (sp.sqrt(omega) * sp.cos(omega * tau + F),)), omega).fields
    ((cos(F(x)),), (-sin(F(x)),))
    """
    theta = sp.Symbol("theta", real=True) if phase is None else phase
    if theta in {system.time, *system.state, *(system.parameters or ())}:
        raise AveragingRefused("form", "phase", f"the system already uses the symbol {theta}; name another phase")
    root = sp.Dummy("root", positive=True)
    drift: list[sp.Expr] = []
    columns: dict[tuple[sp.Expr, int], dict[int, sp.Expr]] = {}
    for row, entry in enumerate(system.rhs):
        where = f"d{system.state[row]}/d{system.time}"
        masked = _waves_in_phase(entry.subs(omega, root**2), system.time, theta, root, where)
        slow, masked = masked.as_independent(root, theta, as_Add=True)
        drift.append(slow)
        for (power, rate), parts in read(masked, theta, where).terms.items():
            for sine, part in enumerate(parts):
                if part != 0:
                    field = _of_root(part, root, power, rate, where)
                    if rate == 0:
                        drift[row] += field
                    else:
                        columns.setdefault((rate, sine), {})[row] = field
    order = sorted(columns, key=lambda key: (key[0], key[1]))
    fields = tuple(tuple(tidy(columns[key].get(row, sp.S.Zero)) for row in range(system.dimension)) for key in order)
    dithers = tuple((sp.sin if sine else sp.cos)(rate * theta) for rate, sine in order)
    period = 2 * sp.pi / sp.gcd_list([rate for rate, _ in order] or [1])
    title = system.name if name is None else name
    result = DitherSystem(system.time, theta, omega, system.state, tuple(drift), fields, dithers, period, name=title)
    _read_back(result, system)
    return result


def _read_back(result: DitherSystem, system: System) -> None:
    """Return if the dither system is the system again, exactly; else raise :class:`AveragingUndecided`."""
    for state, ours, given in zip(system.state, result.to_system().rhs, system.rhs, strict=True):
        if tidy(sp.expand(sp.expand_trig(ours - given))) != 0:
            where = f"d{state}/d{system.time}"
            raise AveragingUndecided(f"{where}: {given} is read as {ours}, which is not shown to be the same")


def _waves_in_phase(masked: sp.Expr, time: sp.Symbol, theta: sp.Symbol, root: sp.Symbol, where: str) -> sp.Expr:
    waves = [node for node in masked.atoms(sp.sin, sp.cos) if root in node.free_symbols]
    return masked.xreplace({wave: wave.func(_in_phase(wave.args[0], time, theta, root, where)) for wave in waves})


def _in_phase(argument: sp.Expr, time: sp.Symbol, theta: sp.Symbol, root: sp.Symbol, where: str) -> sp.Expr:
    argument = sp.expand(argument)
    fast = argument.coeff(root**2 * time)
    rest = sp.expand(argument - fast * root**2 * time)
    if not fast.is_Rational or root in rest.free_symbols:
        raise AveragingRefused(
            "form", where, f"the argument {argument.subs(root**2, sp.Symbol('omega'))} is not m*omega*{time} + g(x)"
        )
    return fast * theta + rest


def _of_root(part: sp.Expr, root: sp.Symbol, power: int, rate: sp.Expr, where: str) -> sp.Expr:
    """The coefficient of a dithered (√ω) or of a slow (no ω) term."""
    if power:
        raise AveragingUndecided(f"{where}: the phase stands outside of sines and cosines")
    polynomial = sp.expand(part)
    field = polynomial.coeff(root, 1) if rate != 0 else polynomial.coeff(root, 0)
    rest = sp.expand(polynomial - field * (root if rate != 0 else 1))
    if rest != 0 and tidy(rest) != 0:
        kind = "a fast term" if rate != 0 else "a term without dither"
        wanted = "exactly the factor sqrt(omega)" if rate != 0 else "no factor of omega"
        shown = rest.subs(root, sp.Symbol("sqrt(omega)"))
        raise AveragingRefused("form", where, f"{kind} must have {wanted}, but there is {shown}")
    return field
