"""``ptproof gains``: numbers or a problem file in, a table or JSON out, and the exit status."""

import functools
import json

import pytest
from click.testing import CliRunner

from ptproof.commands.gains import gains
from ptproof.errors import InputError
from tests.pictures import lines_shown, shown

TWO = ["--kappa", "2", "--a1", "3/2", "--a2", "1/2", "--b1", "1.4", "--b2", "3.3"]
ONE = ["--kappa", "1", "--a1", "1.5", "--a2", "0.5", "--b1", "0.5", "--b2", "3.25"]
KEYS = {
    "constants": {"q", "sigma", "c1", "c2"},
    "asymptotic": {"k_min_printed", "k_min"},
    "prescribed_time": {"overshoot", "rate"},
    "critical": {"V0_at_tau_star", "V0_threshold_printed", "V0_threshold", "T_threshold_printed", "T_threshold",
                 "escape_time"},
    "nonvanishing": {"h1", "h2", "gamma", "ultimate_bound"},
    "clip": {"tau_end", "k_effective", "u1_peak", "residual_bound"},
}  # fmt: skip


def run(arguments):
    result = CliRunner().invoke(gains, arguments, standalone_mode=False)
    if result.exception is not None:
        raise result.exception
    return result


def answer(arguments):
    return json.loads(run([*arguments, "--json"]).stdout)


def leaves(content):
    for section in KEYS:
        yield from content[section].values()


CRITICAL = [*TWO, "--drift-norm", "1.5", "--k", "1.8", "--T", "1", "--V0", "0.5"]
QUADRATIC = [*ONE, "--drift-norm", "1", "--k", "1.8", "--T", "1", "--nu-min", "0.3", "--x0-norm", "2"]


@pytest.mark.parametrize("numbers", [ONE, [*CRITICAL, "--tau-star", "0.1"]])
def test_the_keys_of_the_answer(numbers):
    content = answer(numbers)
    for section, keys in KEYS.items():
        assert keys <= set(content[section])
    for leaf in leaves(content):
        assert leaf is None or set(leaf) == {"exact", "value"}


def test_an_empty_key_says_why():
    content = answer(ONE)
    assert content["clip"]["tau_end"] is None
    assert content["why"]["clip.tau_end"] == "needs T and nu_min"


def test_exact_text_gives_exact_text():
    content = answer([*ONE, "--k", "1.8", "--T", "pi", "--nu-min", "3/10"])
    assert content["clip"]["k_effective"] == {"exact": "20", "value": 20.0}
    assert content["clip"]["tau_end"]["exact"] == "17*pi/3"


def test_the_table_reads_like_an_answer():
    text = run(CRITICAL).stdout
    assert "safe V₀ below, as printed" in text
    assert "0.00349272" in text
    assert "never: V0 is below the threshold" in text


def test_every_line_says_whose_property_it_is():
    text = run([*ONE, "--k", "1.8", "--T", "1", "--nu-min", "3/10", "--omega", "30", "--x0-norm", "1"]).stdout
    rows = {line[11:49].strip(): line[2:11].strip() for line in text.splitlines() if line.startswith("  ")}
    assert rows["at t₀ + T within"] == rows["least k, as printed"] == "average"
    assert rows["peak of u₁"] == rows["circles at 1/√ω, to leading order"] == "vehicle"
    assert (rows["exponent q"], rows["τ reached at t₀ + T"]) == ("field", "clock")
    about = answer([*ONE, "--k", "1.8"])["about"]
    assert about["clip.residual_bound"] == "average"
    assert {key for key, word in about.items() if word == "vehicle"} == {
        "clip.u1_peak", "clip.u2_peak", "vehicle.hover_radius", "vehicle.omega_for_residual",
    }  # fmt: skip


def test_the_answer_stands_first():
    lines = run(["saturated", "--residual", "0.1"]).stdout.splitlines()
    assert lines[0] == "Residual 1/10 at t₀ + T: proved of the average. Of the vehicle it is not."
    assert lines[3].startswith("The average at t₀ + T, from 2.82843 away")
    assert lines.index("Constants") > 10


@pytest.mark.parametrize(
    ("residual", "status", "word"), [("4", 0, "proved of the average"), ("1/1000", 1, "not shown by these bounds")]
)
def test_a_residual_that_is_not_guaranteed_is_status_one(residual, status, word):
    result = run([*QUADRATIC, "--residual", residual])
    assert result.return_value == status
    assert word in result.stdout


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "--kappa, --a1, --a2, --b1, --b2"),
        (["--kappa", "1", "--a1", "1", "--a2", "2", "--b1", "1", "--b2", "1"], "a2 must not exceed a1"),
        (["--kappa", "1", "--a1", "2", "--a2", "1", "--b1", "3", "--b2", "1"], "b1 must not exceed b2"),
        (["--kappa", "1.5", "--a1", "2", "--a2", "1", "--b1", "1", "--b2", "1"], "kappa must be a positive integer"),
        (["--kappa", "0", "--a1", "2", "--a2", "1", "--b1", "1", "--b2", "1"], "kappa must be a positive integer"),
        (["--kappa", "1", "--a1", "2", "--a2", "-1", "--b1", "1", "--b2", "1"], "a2 must be a positive number"),
        ([*ONE, "--nu-min", "1.01"], "nu_min must lie in"),
        ([*ONE, "--nu-min", "0"], "nu_min must be positive"),
        ([*ONE, "--k", "x"], "--k: unknown name 'x'"),
        ([*ONE, "--k", "__import__('os')"], "--k"),
        ([*ONE, "--radius", "1"], "only a problem file"),
        (["vanishing", "--a1", "2"], "missing: --a2, --b1, --b2"),
        (["vanishing", "--kappa", "2"], "has kappa = 1"),
        (["nowhere.toml"], "nowhere.toml: cannot be read"),
    ],
)
def test_bad_input_is_one_sentence(arguments, message):
    with pytest.raises(InputError, match=message.replace("(", r"\(")):
        run(arguments)


@functools.cache
def example(name):
    return answer([name])


@pytest.mark.parametrize("name", ["vanishing", "nonvanishing"])
def test_the_paper_s_examples_have_a_tight_bound(name):
    content = example(name)
    assert content["certificate"]["verdict"] == "proved"
    assert content["tight"]["verdict"] == "proved"
    assert 1 <= content["looseness"]["tight"] <= 3
    assert content["worst_simulated"] <= content["tight"]["distance_at_end"]


def test_the_printed_chain_of_the_first_example_says_nothing():
    content = example("vanishing")
    assert content["bounds_at_end"]["printed"] / 2.8284 == pytest.approx(3.1e4, rel=0.05)
    assert content["asymptotic"]["k_min"]["value"] == 2
    assert content["looseness"]["printed"] > 1e6 > content["looseness"]["closed_form"]


def test_the_clock_of_the_options_is_that_of_every_number():
    content = answer([*QUADRATIC, "--nu-min", "1/10", "--omega", "4", "--clock", "power", "--exponent", "2"])
    assert content["clip"]["k_effective"]["exact"] == "1800"
    assert content["clip"]["tau_end"]["exact"] == "299/2"
    assert content["clip"]["u1_peak"]["exact"] == "2000"
    assert (
        content["why"]["clip.residual_bound_printed"]
        == "printed for the paper's own clock only, not for the power clock"
    )


def test_a_problem_file_says_which_clock(tmp_path):
    clock = '\nnu_min = "1/2"\nclock = "power"\nexponent = 2'
    file = problem_file(tmp_path, "-(x1 - 1)**2 - x2**2", 1, clock)
    content = answer(file)
    assert content["clip"]["k_effective"]["exact"] == "12"
    assert 1 <= content["looseness"]["tight"] <= 3
    assert answer([*file, "--clock", "logarithmic"])["clip"]["k_effective"]["exact"] == "3"


def test_an_exact_expression_is_shown_whole_or_not_at_all():
    lines = run(CRITICAL).stdout.splitlines()
    assert not any("…" in line for line in lines)
    assert any(line.endswith("1.0329  7*2**(3/4)*3**(1/4)/15") for line in lines)


def test_bad_input_names_the_problem(tmp_path):
    file = problem_file(tmp_path, "-(x1 - 2)**2 - x2**2", 1)
    with pytest.raises(InputError, match=r"problem\.toml: the gradient of the field is not zero at the source"):
        run(file)


def test_options_replace_the_problem_s_tuning():
    content = answer(["saturated", "--nu-min", "1/2", "--k", "2"])
    assert content["clip"]["k_effective"]["exact"] == "8"
    assert content["clip"]["tau_end"]["exact"] == "3"
    assert content["worst_simulated"] == pytest.approx(8**0.5 * 2.718281828**-3, rel=1e-4)


PROBLEM = """
[field]
variables = ["x1", "x2"]
expression = "EXPRESSION"
source = ["1", "0"]
kappa = KAPPA
[drift]
kind = "gradient"
E = [["-1/4", "0"], ["1/2", "0"]]
[seeker]
k = "1.5"
omega = "30"
mu = "0.001"
T = "1"
[initial]
x = ["2", "0"]
"""


def problem_file(tmp_path, expression, kappa, more=""):
    text = PROBLEM.replace("EXPRESSION", expression).replace("KAPPA", str(kappa)).replace('T = "1"', f'T = "1"{more}')
    file = tmp_path / "problem.toml"
    file.write_text(text)
    return [str(file)]


def test_a_problem_without_a_clip_has_conditions_but_nothing_at_the_end(tmp_path):
    content = answer(problem_file(tmp_path, "-(x1 - 1)**2 - x2**2", 1))
    assert content["asymptotic"]["k_min"]["value"] == pytest.approx(1 / 4 + (1 / 16 + 1 / 4) ** 0.5)
    assert content["tight"]["distance_at_end"] is None
    assert content["clip"]["tau_end"] is None
    assert "up to t = 0.95" in content["valid"]


def test_a_field_of_another_order_has_no_constants_and_status_one(tmp_path):
    file = problem_file(tmp_path, "-(x1 - 1)**4 - x2**4", 1, '\nnu_min = "1/2"')
    result = run([*file, "--json"])
    assert result.return_value == 1
    content = json.loads(result.stdout)
    assert content["certificate"]["verdict"] == "refuted"
    assert content["constants"]["c1"] is None
    assert content["why"]["constants.c1"] == "the field's constants are refuted"


def test_a_field_of_order_four_in_a_file(tmp_path):
    content = answer(problem_file(tmp_path, "-(x1 - 1)**4 - x2**4", 2, '\nnu_min = "1/2"'))
    assert content["constants"]["q"]["exact"] == "3/4"
    # The push never wins, so that what is safe is the level of V that lies in the ball with these constants.
    radius = float(content["certificate"]["domain"].split()[-1].split("/")[0])
    denominator = content["certificate"]["domain"].split("/")[1:]
    level = content["certificate"]["a2"]["lower"] * (radius / float(denominator[0] if denominator else 1)) ** 4
    assert content["critical"]["V0_threshold"]["value"] == pytest.approx(level, rel=1e-6)
    assert 1 <= content["looseness"]["tight"] <= 3


def test_declared_constants_replace_certified_ones():
    content = answer(["saturated", "--a1", "1", "--a2", "1/4", "--b1", "1/2", "--b2", "2"])
    assert content["certificate"] is None
    assert content["valid"] == "where the declared constants hold"
    assert content["constants"]["c1"]["exact"] == "1/2"


def test_a_radius_below_the_reach_is_refused():
    with pytest.raises(InputError, match=r"radius must be at least 2\.8"):
        run(["saturated", "--radius", "1"])


@pytest.mark.parametrize(
    "arguments",
    [
        [*TWO, *["--drift-norm", "1.5", "--k", "1.8", "--T", "1", "--V0", "0.5"]],
        [*ONE, *["--drift-norm", "1", "--k", "1.8", "--T", "1", "--nu-min", "0.3", "--x0-norm", "2"]],
        [*ONE, *["--drift-bound", "1", "--k", "1.8", "--T", "1", "--nu-min", "0.3", "--x0-norm", "2"]],
        ["saturated"],
    ],
    ids=["critical", "time", "bounded", "problem"],
)
def test_a_picture_shows_its_curves_where_they_are(arguments, tmp_path, saved):
    file = tmp_path / "bounds.png"
    run([*arguments, "--plot", str(file)])
    found = lines_shown(file, saved[0])
    assert found
    hidden = {name for name, share in found.items() if share < 0.4}  # dashes and dots have gaps
    # Without a drift the printed chain and the closed form are one curve, and so are the two least gains.
    assert hidden <= ({"printed", "k = 2(c2/c1)²‖E‖, printed"} if arguments == ["saturated"] else set())


def test_the_picture_s_bound_is_the_one_that_is_printed(tmp_path, saved):
    file = tmp_path / "bounds.png"
    run([*QUADRATIC, "--plot", str(file)])
    bound = answer(QUADRATIC)["clip"]["residual_bound"]["value"]
    axes = saved[0].axes[0]
    line = next(line for line in axes.get_lines() if line.get_label() == "closed form")
    assert (line.get_xdata()[-1], line.get_ydata()[-1]) == pytest.approx((1, bound))
    assert shown(file, axes, 1, bound, line.get_color()) == 1
    assert shown(file, axes, 0.98, 3 * bound, line.get_color()) == 0


def test_a_picture_that_cannot_be_written_is_bad_input(tmp_path):
    with pytest.raises(InputError, match="there is no folder"):
        run([*ONE, *["--k", "1", "--T", "1"], "--plot", str(tmp_path / "missing" / "x.png")])
