"""A derivation drafted from a paper: what its letters may mean, what each formula becomes, and the files that say so."""
