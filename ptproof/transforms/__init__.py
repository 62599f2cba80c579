"""Proof steps that are functions from system to system: changes of time and of states, reduction."""
