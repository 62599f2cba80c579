"""What formulas become: definitions, claims under them, and gaps; and what is said of each."""

import pytest

from ptproof.drafting.headings import outline, slug
from ptproof.drafting.items import items_of
from ptproof.drafting.paper import read_with_guesses
from ptproof.drafting.printing import can_be_written


def items(*formulas, front=""):
    found, _ = items_of(read_with_guesses(front + "".join(f"\\[ {formula} \\]\n" for formula in formulas)))
    return found


KINDS = {
    ("u = -k x",): ["definition"],
    ("u = -k x", "u = -k x"): ["definition", "definition"],
    ("u = -k x", "u = -x k"): ["definition", "definition"],
    ("u = -k x", "u = k x"): ["definition", "claim"],
    ("u = -k x", "u > 0"): ["definition", "claim"],
    ("k > 0",): ["definition"],
    ("k x > 0",): ["claim"],
    ("u = v", "v = u"): ["definition", "claim"],
    ("u = u + v",): ["claim"],
    ("u = v = w",): ["definition"],
    ("u = k x = 2 k x",): ["definition", "claim"],
    ("F(x) = x^2", "F(0) = 0"): ["definition", "claim"],
    ("F(x) = x^2", "F(x) = x^3"): ["definition", "claim"],
    (r"\dot{x} = -x", "V = x^2", r"\dot{V} = -x"): ["definition", "definition", "claim"],
    (r"\dot{x} = -x", "x = y"): ["definition", "gap"],
    (r"\dot{x} = -x", "x(0) = y"): ["definition", "definition"],
    (r"\tau = 2 t", r"\frac{d \tau}{d t} = 3"): ["definition", "claim"],
    ("t = 2", r"\dot{x} = t"): ["gap", "definition"],
    ("u \\approx v",): ["gap"],
    (r"\nu(t - t_0) = 1 - \frac{t - t_0}{T}", r"\nu(t) = 1 - \frac{t}{T}"): ["definition", "definition"],
    (r"\nu(t - t_0) = 1 - \frac{t - t_0}{T}", r"\nu(t) = 1 - \frac{t}{2 T}"): ["definition", "claim"],
    (r"\nu(t - t_0) = 1 - \frac{t + t_0}{T}",): ["claim"],
    (r"\nu(t - 1) = 1 - t", r"\nu(t) = -t"): ["claim", "definition"],
    (r"\nu(t + T) = \nu(t)",): ["claim"],
    (r"\dot{x} = -x", r"V(x(t), \nu(t)) = x + \nu(t)"): ["definition", "definition"],
    ("V(a, b) = a^2", "V(F(0), b) = 3"): ["definition", "claim"],
    (r"m \dot{v} = u - b v",): ["definition"],
    (r"u - b v = m \dot{v}", r"m \dot{v} = 2 u"): ["definition", "claim"],
    (r"m \dot{v} + \dot{x} = u",): ["claim"],
    (r"\dot{v}^2 = u",): ["claim"],
    (r"m \dot{v} \le u",): ["claim"],
    ("V = x^2", r"\dot{x} = -x", r"2 \dot{V} = -x"): ["definition", "definition", "claim"],
}


FIRST = [r"\dot{x} = u(t)", "u(t) = -k x"]
SYSTEMS = {
    (r"\dot{x} = -k x",): ["claim"],
    (r"\dot{x} = -2 k x",): ["claim"],
    (r"\dot{x} = -2 q x",): ["claim"],
    (r"\dot{x} = u(t) + \theta", r"\dot{\theta} = x"): ["definition", "definition"],
    (r"\dot{\theta} = x", r"\dot{x} = u(t) + \theta"): ["definition", "claim"],
    (r"\dot{x} = \theta", r"\dot{\theta} = x", "u(t) = k x", r"\dot{x} = 2 \theta"): [*["definition"] * 3, "claim"],
    (r"\dot{x} \le \theta", r"\dot{\theta} = x"): ["claim", "definition"],
}  # fmt: skip


@pytest.mark.parametrize("formulas", SYSTEMS, ids=str)
def test_another_system_begins_where_something_new_moves(formulas):
    assert [item.kind for item in items(*FIRST, *formulas)][2:] == SYSTEMS[formulas]


def test_a_claim_about_another_system_is_not_under_the_law_of_the_first_one():
    *_, last = items(*FIRST, r"\dot{x} = u(t) + \theta", r"\dot{\theta} = x", "u(t) = 3", r"\dot{x} = 3 + \theta")
    assert [str(fact.pair) for fact in last.givens] == ["u(t) = 3", "x_dot = theta + u(t)"]


def test_a_law_is_written_as_the_paper_has_it_and_used_as_solved():
    law, _, rate = items(r"m \dot{v} = u - b v", "V = m v^2", r"\dot{V} = 2 v u")
    (fact,) = law.facts
    assert (str(fact.said), str(fact.pair)) == ("m*v_dot = -b*v + u", "v_dot = -(b*v - u)/m")
    assert fact in rate.givens


@pytest.mark.parametrize("formulas", KINDS, ids=str)
def test_what_a_formula_becomes(formulas):
    assert [item.kind for item in items(*formulas)] == KINDS[formulas]


def test_what_a_paper_assumes_is_no_claim():
    formula = "\\[ a x^2 \\le F(x) \\]\n"
    assumed = f"\\begin{{assumption}}\n{formula}\\end{{assumption}}\n{formula}"
    found, _ = items_of(read_with_guesses(assumed))
    assert [item.kind for item in found] == ["definition", "claim"]


def test_a_claim_is_under_the_definitions_of_its_letters_those_first_in_which_others_occur_last():
    *_, last = items("w = k x", "u = w + 1", "unused = 1", "V = u^2 + w", "V > 0")
    assert [fact.name for fact in last.givens] == ["w_is", "u_is", "V_is"]


def test_a_definition_that_comes_later_in_the_text_is_not_used():
    first, *_ = items("u + 1 > 0", "u = x^2")
    assert first.givens == ()


def test_the_chain_rule_puts_in_what_has_no_rate():
    *_, last = items(r"\dot{x} = -k x", "y = x - r", "V = y^2 + t", r"\dot{V} \le 0")
    (rule,) = last.rules
    assert str(rule.pair.right) == "x_dot*(-2*r + 2*x) + 1"
    assert [fact.name for fact in last.givens] == ["x_dot_is", "V_dot_is"]


def test_a_letter_that_is_said_twice_is_told():
    *_, second = items("u = x", "u = 2 x")
    assert [str(fact.head) for fact in second.again] == ["u"]
    assert items("u = x", "u > 0")[-1].again == ()


def test_sections_have_files_in_the_order_of_the_text():
    text = r"""
\title{A \emph{short} one\thanks{us}}
\begin{document}
\section{Über \textbf{uns}} \section*{Thanks} \section[x]{Two} \appendix \section{Proofs} \section{} \end{document}
\section{Not there}
"""
    found = outline(text)
    assert found.title == "A short one"
    assert [item.file for item in found.headings] == [
        "section0a_front", "section1_uber_uns", "section1a_thanks", "section2_two", "section2a_appendix_a_proofs",
        "section2b_appendix_b_untitled",
    ]  # fmt: skip
    assert [item.words for item in found.headings][3:5] == ["2 Two", "A Proofs"]


def test_ten_sections_are_sorted_as_they_stand():
    found = [item.file for item in outline("\\section{A}\n" * 12).headings]
    assert found == sorted(found)


def test_a_slug_is_a_part_of_a_name():
    assert slug("") == slug("  ** ") == "untitled"
    assert f"x{slug('Größe & Maß: 2nd')}".isidentifier()


def test_what_has_no_form_in_python_is_told():
    import sympy as sp

    x = sp.Symbol("x", real=True)
    assert can_be_written(sp.sqrt(x) + sp.oo)
    assert not can_be_written(sp.gamma(x))


def test_the_letters_of_a_column_are_known_since_the_line_of_the_column():
    text = "\\[ \\dot{x} = -k x \\]\n\\[ x = [x_1, x_2]^\\top \\]\n\\[ x_1 + q > 0 \\]\n"
    declared = read_with_guesses(text).declared
    assert {name: declared[name].line for name in ("x1", "x2", "q")} == {"x1": 1, "x2": 1, "q": 3}
