"""The paper's lemmas, theorems, identities and statements, each tested on numbers.

A check is a function of plain values that returns a table: a dictionary that
`xarray.Dataset.from_dict` takes. The variables that decide carry the attribute `tolerance`; a check
holds if none of them exceeds it (latticode.datasets.checks.broken). `checks` lists all of them; the
ledger derives verdicts from the tables and trajectories.
"""
