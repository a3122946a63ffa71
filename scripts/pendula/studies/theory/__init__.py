"""The paper's lemmas, theorems, identities and sentences, each tested on numbers.

A check is a function of plain values that returns a table: a dictionary that
`xarray.Dataset.from_dict` takes. The variables that decide carry the attribute `tolerance`; a
check holds when none of them exceeds it (latticode.datasets.checks.broken). `checks` lists all of
them; the ledger turns tables and trajectories into verdicts.
"""
