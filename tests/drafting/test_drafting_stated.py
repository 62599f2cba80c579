"""What a paper says of its letters alone becomes an assumption of claims, where it plainly holds throughout."""

import pytest

from ptproof.commands.starter import write_files
from ptproof.drafting.draft import draft
from ptproof.drafting.items import items_of
from ptproof.drafting.paper import read_with_guesses
from ptproof.proof.deciding import run_one
from ptproof.proof.load import load

FRONT = r"\newcommand{\R}{\mathbb{R}}\begin{document}" + "\n"
DISPLAY = r"\[ k + T + \omega x + \kappa + t + t_0 \le y \]" + "\n\n"


def stated(text):
    return read_with_guesses(FRONT + DISPLAY + text).conditions


def taken(text):
    return [str(item.pair) for item in stated(text).taken]


TAKEN = {
    "The gain is $k > 0$.": ["k > 0"],
    r"Here $0 < k$.": ["k > 0"],
    r"with $k, \omega > 0$ and $x \le 2$": ["k > 0", "omega > 0", "x <= 2"],
    r"with $k \in (0, 1)$": ["k > 0", "k < 1"],
    r"with $k \in \left(0, \infty\right)$": ["k > 0"],
    r"on $t \in [t_0, t_0 + T)$": ["t >= t0", "t < T + t0"],
    r"on $t \in J := [t_0, t_0 + T)$": ["t >= t0", "t < T + t0"],
    r"on $J := [t_0, \infty)$ a time $t \in J$": ["t >= t0"],
    r"where $k, x \in \R_{>0}$": ["k > 0", "x > 0"],
    r"where $k \in \R_{\geq 0}$": ["k >= 0"],
    r"Let $\kappa \in \mathbb{N}$.": ["kappa >= 0"],
    r"Let $k > 0$ be the gain.": ["k > 0"],
    r"Consider the system with $k > 0$.": ["k > 0"],
    r"If it rains, we stay. The gain is $k > 0$.": ["k > 0"],
    r"with $0 < k < 1$": ["k > 0", "k < 1"],
    r"with $k > 0$, and $k > 1$": ["k > 0"],
    r"with $k > 0$, and $k \ge 0$": ["k >= 0"],
    "\\[ y = k x, \\qquad y > 0 \\]": [],
    "\\[ k > 0 \\]": ["k > 0"],
}  # fmt: skip
LEFT = {
    "if $k > 0$": "if",
    "stable when $k < 1$": "when",
    r"with $k > 0$ \[ k = x^2 \]": "defines",
    r"\[ k = x^2, \quad x = t \] is positive, \[ k > 0 \]": "defines",
    r"with $k > 0$ \[ \dot{k} = 1 \]": "moves",
    "For $k > 1$, it is stable.": "For",
    r"for all $k > 0$ and $\omega > 0$": "for all",
    r"It holds for all $t$, $k > 0$.": "for all",
    "it is stable, $k > 0$, if it rains": "if",
    "Suppose $k > 0$.": "Suppose",
    "Let $k > 0$. Then it holds.": "let so",
    "Consider $k > 0$.": "let so",
    "Hence $k > 0$.": "Hence",
    "We add both, so that $k > 0$.": "that",
    r"We then have \[ k > 0. \]": "have",
    "there exists $k > 0$": "exists",
    "In the first case $k > 0$.": "case",
    r"By Def. 3 it is stable unless, cf. Thm. 2, $k > 0$.": "unless",
    "with $k > 0$, and with $k < -1$": "otherwise",
    "with $k > 0$, and then $k = -1$": "otherwise",
    "with $k > 0$, and $k < 0$": "otherwise",
    "with $k < T$, and $k > T$": "otherwise",
    r"with $t \ge t_0$, and $t \ge T$": "less",
}  # fmt: skip
NOTHING = ["with $k = 1$", r"with $k x > 0$", r"with $k \ne 0$", r"with $k > x^2$", r"with $k \in \mathbb{R}_+$",
           r"the set $\{ k > 0 \}$", r"with $q > 0$ and $\forall k > 0$", r"with $k \in \mathcal{K}$"]  # fmt: skip


@pytest.mark.parametrize("text", TAKEN)
def test_what_plainly_holds_is_taken(text):
    assert taken(text) == TAKEN[text]


@pytest.mark.parametrize("text", LEFT)
def test_what_may_be_local_is_left_with_its_reason(text):
    found = stated(text)
    assert not found.taken
    assert any(LEFT[text] in why for _, why in found.left)


@pytest.mark.parametrize("text", NOTHING)
def test_what_is_no_bound_of_a_letter_is_not_taken(text):
    assert "k" not in {str(item.pair.left) for item in stated(text).taken}


def test_a_claim_takes_those_of_its_letters_and_of_their_bounds():
    text = r"with $k > 0$, $T > 0$, $t_0 \ge 0$, $\omega > 0$, and $t \in [t_0, t_0 + T)$ \[ t k \ge 0 \]"
    found, _ = items_of(read_with_guesses(FRONT + DISPLAY + text))
    assert {item.name for item in found[-1].stated} == {"k_stated", "T_stated", "t0_stated", "t_stated", "t_stated_2"}


PAPER = r"""\begin{document}
\section{Gains}
%s
\begin{equation} k x^2 \ge 0 \label{eq:sign} \end{equation}
\end{document}
"""


@pytest.mark.parametrize(
    ("text", "verdict"),
    [
        ("The gain is $k > 0$.", "proved"), ("The gain is $k < 0$.", "refuted"), ("If $k > 0$, it holds.", "refuted"),
        ("The gain is $k > 0$, here also $k < T$, and $T < 0$.", "undecided"),
    ],
)  # fmt: skip
def test_the_verdict_rests_on_what_is_said(tmp_path, text, verdict):
    (tmp_path / "gains.tex").write_text(PAPER % text)
    write_files(tmp_path / "gains", draft(tmp_path / "gains.tex").files)
    [claim] = load([tmp_path / "gains"]).claims
    assert str(run_one(claim).verdict) == verdict
