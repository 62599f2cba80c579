"""Newton nonholonomic source seeking for distance-dependent maps (Todorovski and Krstic), section by section."""
