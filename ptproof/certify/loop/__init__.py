"""Guarantees for the vehicle in closed loop."""
