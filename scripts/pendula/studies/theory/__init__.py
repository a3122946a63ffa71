"""The paper's lemmas, theorems, identities and sentences, each tested on numbers.

A check is a function of plain values that returns a table: a dictionary that
`xarray.Dataset.from_dict` takes. Its deciding variables carry the attribute `tolerance`; a check
holds when none of them exceeds it (`tables.broken`). The ledger turns tables and trajectories
into verdicts.
"""
