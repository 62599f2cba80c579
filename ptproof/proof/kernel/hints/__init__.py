"""What is looked for before Coq is asked: multipliers, cases, witnesses, bounds. Coq checks each of them or fails."""
