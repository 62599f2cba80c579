"""Corrupted claims: made by kind, held against the original, attacked and given to the original's proof."""
