"""Kernels generated from the graph of a model: right-hand sides, tangents and power series.

`modules` assembles a module of source code. `rate_rules` generates its right-hand sides and
`series_rules` its power series, both by `statements`. `toolbox` has all names that generated code
uses. `chain` and `series` have the loops over sites.
"""
