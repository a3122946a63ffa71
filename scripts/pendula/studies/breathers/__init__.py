"""Breathers: localised states that stay, and what they say of the paper's large case."""
