"""What is simulated and drawn for the second paper alone."""
