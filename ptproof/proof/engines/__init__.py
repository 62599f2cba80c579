"""What decides: one file an engine, each for one kind of statement."""
