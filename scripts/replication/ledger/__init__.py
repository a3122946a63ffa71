"""The ledger of claims: every sentence of the paper that numbers can decide, with its verdict.

`claim`      a claim, as a study declares it above the function that decides it
`chances`    how likely another right run turns a verdict
`changes`    the verbs that make wrong cases
`criterion`  what decides, and prints itself
`cutoff`     the numbers that decide, where each comes from, and what follows if one moves
`missing`    what is missing from a dataset, and confirms nothing
`rows`       the rows of a run, counts of them, and the numbers that others quote from them
`decide`     the jobs that write the parts of the ledger and join them in a table
`verdicts`   the verdict on each claim, with what its controls say
"""
