"""Everything in ball arithmetic: values that enclose, and searches that cover a whole domain."""
