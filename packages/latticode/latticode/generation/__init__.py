"""Kernels generated from the graph of a model: right-hand sides, tangents and power series.

`modules` assembles a module of source code from right-hand sides (`rate_rules`) and power series
(`series_rules`). Both consist of `statements`. Generated code imports all its names from `toolbox`.
`chain` and `series` have the loops over sites.
"""
