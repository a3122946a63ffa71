"""Trajectories in multiprecision arithmetic, with more digits than chaos destroys."""
