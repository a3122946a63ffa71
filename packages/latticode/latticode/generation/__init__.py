"""Kernels written from the graph of a model: right-hand sides, tangents and power series.

`modules` puts a module of source code together, of which `rate_rules` writes right-hand sides and
`series_rules` power series, as `statements`. What the written code calls is in `toolbox`; `chain`
and `series` walk over the sites of a state.
"""
