"""Localised states and their stability; tangent vectors, Lyapunov exponents and sections."""
