"""A derivation drafted from a paper: what its letters may mean, what formulas become, and the files that say so."""
