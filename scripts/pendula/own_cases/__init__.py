"""Checks, figures and a page for the cases and sweeps that a user brings.

This room stands above the studies and uses them, since a user has the questions of the studies:
until when a run can be trusted, and what the theorems state about the case.
"""
