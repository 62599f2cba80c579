"""Practical prescribed-time seeking of a repulsive source (Todorovski and Krstic), section by section."""
