"""Checks of a case of one's own: a run beside the paper's statements, and how far it is true.

`statements` holds what the paper proves of any data; theory.bounds, theory.linear_stability and
theory.estimates have the proofs. `second_run` and `sensitivity` measure until when the numbers are
those of the solution. `checks` puts them into one dataset.
"""
