"""Coupled PT-symmetric dNLS chains: the equations, their solvers, datasets and plots."""

__version__ = "0.1.0"
