"""Breathers: localised states, their stability, and the fate of initial conditions on one pair."""
