"""``python -m ptproof``, the same as the command ``ptproof``."""

from ptproof.commands.cli import main

main()
