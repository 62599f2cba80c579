"""One module per command: arguments and calls, nothing else."""
