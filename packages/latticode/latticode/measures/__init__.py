"""Measures of runs and sweeps, each with one definition.

`difference`  how far two runs differ, and from when on (the divergence time)
`norms`       measures of one run: P, largest amplitude, drift of the energy, margin to (19)
`levels`      curves against a parameter: levelling off, range, rising steps; bands and means
`spreading`   lines through l2^2, exponents of tau with an offset, each with its limits
`growth`      local exponents of time, rates of tangent vectors with their errors; what is chaotic

Whatever is published is measured here, stored by a study below results/checks/, and read from there
by figures, tables, claims and the report.
"""
