"""``ptproof bounds``: certify the constants of a field."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from ptproof.commands import options
from ptproof.errors import InputError

if TYPE_CHECKING:
    from ptproof.certify import FieldCertificate


class _WithExpression(click.Command):
    """A command whose argument may begin with a minus sign."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        known = {name: param for param in self.get_params(ctx) for name in param.opts}
        front: list[str] = []
        back: list[str] = []
        rest = iter(args)
        for token in rest:
            if token == "--":
                back.extend(rest)
            elif token in known:
                front.append(token)
                param = known[token]
                if not (isinstance(param, click.Option) and param.is_flag) and (value := next(rest, None)) is not None:
                    front.append(value)
            elif token.startswith("--"):
                front.append(token)
            else:
                back.append(token)
        return super().parse_args(ctx, [*front, "--", *back])


@click.command(cls=_WithExpression)
@click.argument("expression", metavar="EXPR")
@click.option("--vars", "names", metavar="x1,x2", required=True, help="The variables, in order.")
@click.option("--source", metavar="0,0", help="The coordinates of the source, exact; the origin if left out.")
@click.option("--kappa", metavar="K", required=True, help="The order: 2K is the power of the distance.")
@click.option("--radius", metavar="R", help="Look at the ball of this radius around the source.")
@click.option("--annulus", metavar="r,R", help="Look at the points at a distance between r and R.")
@click.option("--rtol", type=float, default=1e-3, show_default=True, help="Relative width of each enclosure.")
@click.option("--timeout", type=float, default=60.0, show_default=True, help="Time limit, in seconds.")
@click.option("--plot", metavar="FILE", help="Write a picture of the quotients and the certified band.")
@options.as_json
def bounds(
    expression: str,
    names: str,
    source: str | None,
    kappa: str,
    radius: str | None,
    annulus: str | None,
    rtol: float,
    timeout: float,
    plot: str | None,
    as_json: bool,
) -> int:
    """Certify the best constants a1, a2, b1, b2 of the field EXPR, or show why there are none.

    Without --radius and --annulus the domain is the whole space. Exit status 1 if the constants are not proved.

    \b
    Example:  ptproof bounds "5/2 + cos(2*pi/3*x1)/2 - (x1**2 + x2**2)/2" --vars x1,x2 --kappa 1
    """
    from ptproof.proof.verdict import Verdict

    certificate = _certificate(timeout, expression, names, source, kappa, radius, annulus, rtol)
    if plot is not None:
        _draw(certificate, plot)
    if as_json:
        if certificate.verdict is Verdict.UNDECIDED:
            click.echo(f"ptproof: {certificate.summary}", err=True)
        options.print_json(certificate.to_json())
    else:
        _show(certificate)
    return 0 if certificate.verdict is Verdict.PROVED else 1


def _certificate(seconds: float, *data: Any) -> FieldCertificate:
    """The certificate of a field given as text, from a process that is ended when it takes much longer."""
    from ptproof.reading.limits import Answered, Unanswered, Why, apart, check_seconds

    check_seconds(seconds, "--timeout")
    match apart(2 * seconds + 5, _certify, seconds, *data):
        case Answered(certificate):
            return certificate
        case Unanswered(Why.TIME):
            raise InputError(f"no answer within {seconds:g} s: the expression is too large for exact algebra")
        case Unanswered(Why.FAILED, _, Exception() as error):
            raise error
        case Unanswered(_, reason):
            raise InputError(f"the computation ended without an answer ({reason})")


def _certify(
    seconds: float, expression: str, names: str, source: str | None, kappa: str, radius: str | None,
    annulus: str | None, rtol: float,
) -> FieldCertificate:  # fmt: skip
    import sympy as sp

    from ptproof.certify import certify_field
    from ptproof.reading.expressions import parse
    from ptproof.reading.tables import RESERVED, declared, split_list

    variables = [sp.Symbol(name, real=True) for name in declared(split_list(names), "--vars", RESERVED)]
    at = ["0"] * len(variables) if source is None else split_list(source)
    ends = None if annulus is None else [parse(end, where="--annulus") for end in split_list(annulus)]
    if ends is not None and len(ends) != 2:
        raise InputError(f"--annulus: expected two radii r,R, got {annulus!r}")
    return certify_field(
        parse(expression, variables, where="EXPR"),
        variables,
        [parse(entry, where="--source") for entry in at],
        parse(kappa, where="--kappa"),
        radius=None if radius is None else parse(radius, where="--radius"),
        annulus=None if ends is None else (ends[0], ends[1]),
        rtol=rtol,
        seconds=seconds,
    )


def _draw(certificate: FieldCertificate, path: str) -> None:
    try:
        certificate.plot(path)
    except (OSError, ValueError) as error:
        raise InputError(f"--plot: cannot write a picture to {path!r} ({error})") from None


def _show(certificate: FieldCertificate) -> None:
    from rich.text import Text

    from ptproof.commands.terminal import COLOURS, output, plain_table
    from ptproof.proof.verdict import Verdict

    console = output()
    head, _, *lines = str(certificate).splitlines()
    console.print(Text(head))
    console.print(Text(certificate.summary, style=COLOURS[str(certificate.verdict)]))
    rows = certificate.rows()
    for line in lines[: len(lines) - len(rows)]:
        console.print(Text(line))
    if not rows:
        return
    console.print(plain_table(("constant", "meaning", "enclosure"), rows))
    shown = certificate.smaller or certificate
    if shown.verdict is Verdict.UNDECIDED and shown is not certificate:
        console.print(Text(shown.summary, style=COLOURS["undecided"]))
    if shown.verdict is Verdict.PROVED:
        found, where = shown.field_bounds(), "" if shown is certificate else f" on {shown.domain.readable}"
        text = ", ".join(f"{name} = {float(getattr(found, name)):.9g}" for name in ("a1", "a2", "b1", "b2"))
        console.print(Text(f"constants that certainly hold{where}: {text}", style="bold"))
