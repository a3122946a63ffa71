"""Functions of the rules: names of files, values for jobs, hashes of code, and checks before a run.

Only Snakemake imports this package; jobs do not.
"""
