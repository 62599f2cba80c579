"""What is measured, and against which peers; each module is a command: ``python -m benchmarks.simulation``."""
