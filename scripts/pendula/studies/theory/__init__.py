"""The paper's lemmas, theorems, identities and statements, each checked on numbers.

A check is a function of plain values that returns a table: a dictionary for
`xarray.Dataset.from_dict`. The check holds if no variable exceeds its attribute `tolerance`
(latticode.datasets.checks.broken). `checks` lists all checks; the ledger derives verdicts from the
tables and trajectories.
"""
