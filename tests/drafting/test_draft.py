"""A derivation drafted from a paper: it loads, its claims are decided, and the paper is found in it again."""

import subprocess
import sys
from collections import Counter

import pytest

from ptproof.commands.starter import write_files
from ptproof.drafting.draft import draft
from ptproof.errors import InputError
from ptproof.proof.deciding import run_one
from ptproof.proof.load import load
from ptproof.reading.latex.formulas import find_formulas
from ptproof.report.coverage import coverage
from ptproof.report.labels import equation_labels
from ptproof.report.printed import compare_all
from ptproof.report.stated import printed

LOOP = r"""
\documentclass{IEEEtran}
\newcommand{\err}{\epsilon}
\def\J{\begin{bmatrix} 0 & 1 \\ -1 & 0 \end{bmatrix}}
\begin{document}
\section{A loop with an "integrator"}
\begin{IEEEeqnarray}{rCl}
\dot{y} &=& -a y + b u \IEEEyesnumber \label{eq:plant} \\
\dot{q} &=& \err
\end{IEEEeqnarray}
\begin{subequations} \label{eq:law}
\begin{align} \err &= r - y \\ u &= K \err + L q \end{align}
\end{subequations}
\begin{multline} \dot{\err} = -(a + b K) \err \\ - b L q + a r \label{eq:error} \end{multline}
\[ \phi(y) = \sup_s F(s, y) \]
\section*{Ways to $V$ \textbackslash}
\[ G(y, q) = \frac{b}{2} q^2 + \frac12 y^2, \quad G(0, 0) = 0 \]
\[ \frac{\partial G}{\partial q} = b q, \qquad G(q, q) = \frac{1 + b}{3} q^2 \]
\[ \int_0^1 s \,\mathrm{d} s = \frac12 \]
\begin{equation} A = \J, \quad A A = -I \label{eq:turn} \end{equation}
with $a, b > 0$ and $K = 1$
\[ y = \frac{1
"""
VERDICTS = {
    "1/error": "proved", "1a/1-1-holds": "proved", "1a/1-2": "refuted", "1a/1-3": "proved", "1a/turn-holds": "proved",
}  # fmt: skip


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "loop.tex").write_text(LOOP)
    write_files(tmp_path / "loop", draft(tmp_path / "loop.tex").files)
    return tmp_path / "loop"


def compared(folder):
    return compare_all(find_formulas(LOOP), printed(load([folder])))


def test_it_loads_and_each_claim_gets_its_verdict(folder):
    found = load([folder])
    assert {item.id: str(run_one(item).verdict) for item in found.claims if item.id in VERDICTS} == VERDICTS
    assert all("guessed" in item.title for item in (*found.claims, *found.definitions))
    assert all(str(item.expected) == "proved" for item in found.claims)


def test_what_was_not_read_is_a_gap_and_covers_nothing(folder):
    found = load([folder])
    assert [(item.place, item.line) for item in found.gaps] == [("Section 1 (6)", 15), ("Section 1 (5)", 22)]
    assert r"\sup is not known" in found.gaps[0].why
    items = [*found.claims, *found.definitions]
    assert coverage(equation_labels(LOOP), items).complete


def test_the_paper_is_found_in_it_again(folder):
    found = Counter(item.read for item in compared(folder))
    assert found == {"equal": 9, "not read": 2}


@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        ("-a*y + b*u", "-a*y - b*u"),
        ("b*q**2/2", "b*q**2/3"),
        ("sp.Rational(1, 2)", "sp.Rational(1, 3)"),
        ("L*q", "L*y"),
    ],
)
def test_a_printed_side_with_a_slip_is_different(folder, right, wrong):
    changed = 0
    for file in folder.glob("section*.py"):
        text = file.read_text()
        changed += right in text
        file.write_text(text.replace(right, wrong))
    assert changed
    assert "different" in {item.read for item in compared(folder)}


def test_a_file_says_what_is_for_the_author(folder):
    letters = (folder / "notation.py").read_text()
    assert "# line 21: a, b > 0\na_stated = gt(a, 0)\n# line 21: a, b > 0\nb_stated = gt(b, 0)\n" in letters
    assert "positive=True" not in letters.replace('gain", positive=True)`', "")
    assert "# line 21: K = 1" in (folder / "section1a_ways_to_v.py").read_text()


def test_every_line_of_it_is_clean(folder):
    command = [sys.executable, "-m", "ruff", "check", "--isolated", "--line-length", "120", "--select", "E,F,B,UP,C4"]
    done = subprocess.run([*command, str(folder)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout


BODIES = [
    r"\[ x", "$$ x = y", r"\begin{align} x &= y \\ & = ", r"\section{\[ x = 1 \]", r"\[ \x \y = \]",
    r"\[ x = y \] \input{no}",
    r"\[ '''x''' = ''' \] \section{\"\"\" ''' \n \\}", "\\[ x = \"\"\" \\]\\[ \\unknown \\]", r"\[ \frac{x} = \dot \]",
    r"\[ {x = y} } \]", r"\[ \mathbf{} = \bar{} \]", r"\[ x_{}^{} = () \]", "\\[ ж_ё = ß^{ö} + α \\]",
    r"\[ f() = g(,) \]",
    r"\newcommand{\a}{\a} \[ \a = 1 \]", r"\[ \int \sum \lim = 1 \]", r"\[ x = \begin{bmatrix} \end{bmatrix} \]",
    r"\[ \dot{\dot{x}} = \dot{x}(x(x)) \]", r"\[ [f, g] = 0 \]", r"\[ 1 = 1 \]", r"\[ lambda = import \]",
    "\\[ " + "(" * 400 + "x" + ")" * 400 + " = 1 \\]",
]  # fmt: skip


@pytest.mark.parametrize("body", BODIES, ids=range(len(BODIES)))
def test_bad_latex_is_a_gap_and_what_is_written_compiles(tmp_path, body):
    (tmp_path / "bad.tex").write_text(f"{body}\n\n\\[ p = q \\]\n")
    found = draft(tmp_path / "bad.tex")
    for name, text in found.files.items():
        if name.endswith(".py"):
            compile(text, name, "exec")
    assert sum(found.counts.values()) >= 1
    assert all(item.why for item in found.gaps)


@pytest.mark.parametrize("content", [b"", b"no formula", b"\x00\x01\x02", b"% \\[ x = 1 \\]"])
def test_a_file_without_formulas_is_refused(tmp_path, content):
    (tmp_path / "paper.tex").write_bytes(content)
    with pytest.raises(InputError, match=r"paper\.tex: "):
        draft(tmp_path / "paper.tex")
