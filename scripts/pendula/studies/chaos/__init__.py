"""Chaos in the chain: Lyapunov exponents, ensembles of runs, and the transition to the chaotic
state."""
