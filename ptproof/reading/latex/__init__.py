"""LaTeX from outside: the formulas of a paper, and what they say, through a table of its notation."""
