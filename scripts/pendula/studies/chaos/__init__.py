"""Chaos in the chain: Lyapunov exponents, ensembles, and the transition to the chaotic state."""
