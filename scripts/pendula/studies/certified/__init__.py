"""Proofs: error bounds of computed curves, and the existence of steady breathers."""
