"""What the rules share: names of files, values for jobs, hashes of code, and what is refused.

Snakemake alone imports this room, and no job does.
"""
