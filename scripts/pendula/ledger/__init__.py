"""The ledger of claims: every sentence of the paper that numbers can decide, with its verdict.

`claim`      a claim, as a study declares it above the function that decides it; all their verdicts
`chaotic`    which cases are chaotic, by cut-offs
`criterion`  what decides, and prints itself
`cutoff`     the numbers that decide, where each comes from, and what follows if one moves
`section`    the ledger's part of the report
`tables`     the ledger as files: JSON, and tables to read

Each study keeps its claims in its own folder, in modules whose names start with `claims`.
"""
