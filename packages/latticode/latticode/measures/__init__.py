"""Measures of runs and sweeps, each with one definition.

`difference`  difference of two runs, and the divergence time
`norms`       power P, largest amplitude and energy drift of one run
`levels`      curves against a parameter: levelling off, range; moments and quantiles of ensembles
`spreading`   fits of l2^2 behind a front, with confidence intervals
`growth`      growth rates of tangent vectors with their errors; the test for chaos
`confidence`  confidence intervals

Published numbers are measured here and stored by a study below results/checks/. Figures, tables,
claims and the report read them from there.
"""
