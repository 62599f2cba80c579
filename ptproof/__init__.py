"""Derives, decides and simulates prescribed-time source seeking from one symbolic source."""

__version__ = "0.1.0"
