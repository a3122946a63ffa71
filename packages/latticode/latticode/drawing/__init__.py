"""How figures of runs and sweeps look, how they are saved, and what they show in words."""
