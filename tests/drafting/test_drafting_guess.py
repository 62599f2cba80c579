"""What a letter is taken for, from how it is written, and where two readings are left."""

import pytest

from ptproof.drafting.names import python_name
from ptproof.drafting.paper import read_with_guesses


def read(*formulas, running=""):
    return read_with_guesses(running + "".join(f"\\[ {formula} \\]\n" for formula in formulas))


def table(*formulas, running=""):
    return read(*formulas, running=running).table


@pytest.mark.parametrize(
    ("key", "name"),
    [
        ("x_1", "x1"), (r"\omega_0", "omega_0"), (r"\bar{x}_1", "x_bar_1"), (r"\hat{\tilde{d}}", "d_tilde_hat"),
        ("F^*", "F_star"), (r"\lambda", "lambda_"), ("E", "E_"), ("l", "l_"), (r"\mathbf{x}", "x"), ("β", "beta"),
        ("Ω", "Omega"), ("ü", "u"), (r"K_{\text{max}}", "K_max"), (r"\mathcal{V}", "V_cal"), ("ж", "zhe"),
    ],
)  # fmt: skip
def test_a_letter_has_a_name_in_python(key, name):
    assert python_name(key) == name
    assert python_name(key, [name]) == f"{name.rstrip('_')}_2"


FUNCTIONS = {
    ("V = F(x) + x",): {"F": "F"},
    ("V = F(0)",): {"F": "F"},
    ("V = f(t, 2 x)",): {"f": "f"},
    ("V = u(k t) + k",): {"u": "u"},
    (r"V = \nu(t - t_0) + t",): {r"\nu": "nu"},
    (r"\dot{x} = -x(t)",): {"x": "x"},
    (r"\dot{x} = u(t) + u",): {"u": "u"},
    # Products, and what has two readings.
    ("V = k (x - y) + k",): {},
    ("V = h (x - y)",): {},
    ("V = u(k t) + u + k",): {},
    (r"\dot{d} = d (1 - x), \quad d(0) = 1",): {},
}


@pytest.mark.parametrize("formulas", FUNCTIONS, ids=str)
def test_what_is_a_function(formulas):
    assert table(*formulas)["functions"] == FUNCTIONS[formulas]


REFUSED = {
    "V = h (x - y)": "product and a function",
    "V = u(k t) + u + k": "product and a function",
    "V = e + e^{x}": "e stands alone elsewhere",
    "V = e + e^{-2}": "e stands alone elsewhere",
    "V = e + e^{2 x}": "e stands alone elsewhere",
    r"V = \mathbf{x} + 1": "of what size",
    r"V = x^\top y": "of what size",
    r"\dot{d} = d (1 - x), \quad d(0) = 1": "product and a function",
    r"\lim_{t \to \infty} \dot{x}(t) = x(t)": "all of its trajectory",
    r"\dot{x} = -x, \quad |x(t)| \le x(0)": "along a trajectory",
    r"V = \text{sat}(x)": "says nothing of",
    r"V = \frac{1}{0}": "division by 0",
    "V(0) = V + 1": "does not say of what it is a function",
    r"\unknown{V} = 1": "is not known",
}


@pytest.mark.parametrize("formula", REFUSED)
def test_what_has_two_readings_or_none_is_not_read(formula):
    (said,) = read(formula).said
    assert said.reading is None
    assert REFUSED[formula] in said.why


@pytest.mark.parametrize("formula", [r"V = h (x - y) + h", r"V = e^{x}", r"\dot{x} = -x(t)", r"\dot{d} = d (1 - x)"])
def test_the_same_with_one_reading_is_read(formula):
    (said,) = read(formula).said
    assert said.reading is not None, said.why


MATRICES = {
    (r"A = \begin{bmatrix} 0 & 1 \\ a & b \end{bmatrix}",): {"A": [["A11", "A12"], ["A21", "A22"]]},
    (r"x = [x_1, x_2]^\top",): {"x": ["x1", "x2"]},
    (r"x = \begin{pmatrix} p \\ q \end{pmatrix}", r"\dot{x} = 0"): {"x": ["p", "q"]},
    (r"x = \begin{bmatrix} 1 \\ 2 \end{bmatrix}", r"V = \bar{x}^\top \bar{x}"): {r"\bar{x}": ["x_bar_1", "x_bar_2"]},
    (r"x = [x_1, x_2]^\top", r"V = x^\top P x"): {"P": [["P11", "P12"], ["P21", "P22"]]},
    (r"x = [x_1, x_2]^\top", r"y = 2 x"): {"y": ["y1", "y2"]},
    (r"A = \begin{bmatrix} 0 & 1 \\ a & b \end{bmatrix}", "A^{T} A = -I"): {"I": [["1", "0"], ["0", "1"]]},
}


@pytest.mark.parametrize("formulas", MATRICES, ids=str)
def test_what_is_a_column_or_a_matrix(formulas):
    assert MATRICES[formulas].items() <= table(*formulas)["letters"].items()


def test_running_text_tells_of_sizes():
    found = table(r"\dot{x} = A x", running=r"Let $x \in \mathbb{R}^2 = X$, $A \in \mathbb{R}^{2 \times 2} = Y$. ")
    assert found["letters"]["A"] == [["A11", "A12"], ["A21", "A22"]]


def test_a_size_that_is_no_number_tells_nothing():
    assert table("V = A + x", running=r"$x \in \mathbb{R}^n = X$ ")["letters"]["x"] == "x"


def test_times_and_rates():
    found = read(r"\frac{\mathrm{d} x}{\mathrm{d} \tau} = \dot{y} + x(\tau)")
    assert found.table["times"] == ["t", "tau"]
    assert dict(found.rates) == {"x_by_tau": "rate(x, tau)", "y_by_t": "rate(y, t)"}
    assert found.table["means"]["x(tau)"] == "x"


def test_an_operator_that_the_paper_declares_is_a_word():
    found = read("V = \\dist(x) + d + i", running="\\DeclareMathOperator{\\dist}{dist}\n")
    assert found.table["functions"] == {r"\text{dist}": "dist"}


def test_a_dotted_matrix_function_with_a_transpose_is_no_product_with_its_time():
    found = read(r"Y(t) = \begin{bmatrix} a & b \\ c & p \end{bmatrix}", r"\dot{Y}^\top(t) = Y(t)")
    assert str(found.said[1].reading.pairs[0]) == "Y11_dot = Y11"


def test_a_rate_of_a_rate_has_a_name():
    found = read(r"\ddot{x} = -\dot{x}", r"\frac{\mathrm{d}}{\mathrm{d} t} \dot{x} = -x")
    assert dict(found.rates) == {"x_dot": "rate(x, t)", "x_ddot": "rate(rate(x, t), t)"}
    assert [str(said.reading) for said in found.said] == ["x_ddot = -x_dot", "x_ddot = -x"]


def test_a_value_of_a_letter_does_not_spoil_the_formulas_in_which_it_stands_alone():
    first, second = read("V = x + 1", "V(0) = 1").said
    assert str(first.reading) == "V = x + 1"
    assert second.reading is None


@pytest.mark.parametrize(("formula", "meaning"), [("V = e + e^2 + e^{3}", "e**3 + e**2 + e"), ("V = e^2", "exp(2)")])
def test_a_letter_e_has_whole_numbers_for_powers(formula, meaning):
    (said,) = read(formula).said
    assert str(said.reading.pairs[0].right) == meaning
