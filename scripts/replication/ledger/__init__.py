"""The ledger of claims: each sentence of the paper that numbers can decide, with its verdict.

`claim`      a claim, as a study declares it above the function that decides it
`chances`    the chance that another correct run changes a verdict
`changes`    functions that turn datasets into wrong cases
`criterion`  inequalities on measured numbers, with their text
`cutoff`     the numbers in criteria, their origins, and the verdicts if one is changed
`missing`    data that are missing from a dataset, so that it confirms no claim
`rows`       the rows of a run's ledger, and counts of them
`decide`     the jobs that write the parts of the ledger and join them in a table
`verdicts`   the verdict on each claim, with the outcomes of its controls
"""
