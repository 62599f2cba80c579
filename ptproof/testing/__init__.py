"""Assertions for other people's test suites."""
