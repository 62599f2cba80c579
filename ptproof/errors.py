"""What ptproof raises when the input, not the mathematics, is at fault."""


class InputError(ValueError):
    """Bad input: one sentence that says what is wrong, where, and what would be right.

    The command line prints the sentence and ends with status 2; in Python it is a ``ValueError``.

    >>> import ptproof
    >>> try:
    ...     ptproof.load("nowhere.toml")
    ... except ptproof.InputError as error:
    ...     print(error)
    nowhere.toml: cannot be read (No such file or directory)
    """
