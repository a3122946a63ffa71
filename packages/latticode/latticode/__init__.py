"""Chains of coupled oscillators: equations written once, compiled, integrated and measured.

A model is a function of its fields (see `equations.model`); kernels follow from its trace.
"""

__version__ = "0.1.0"
