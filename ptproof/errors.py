"""What ptproof raises when the input, not the mathematics, is at fault."""


class InputError(ValueError):
    """Bad input: one sentence that says what is wrong, where, and what would be right.

    The command line prints the sentence and ends with status 2; in Python it is a ``ValueError``.
    """
