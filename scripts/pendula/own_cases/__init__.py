"""Checks, figures and a report for a user's cases and sweeps.

This package imports functions of the studies: the horizon of trust of a run, and the theorems for
its case.
"""
