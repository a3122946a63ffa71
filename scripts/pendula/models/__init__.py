"""The equations, once each: what a solver, an observable or a check needs of a model.

`amplitudes` holds the paper's equations (4) and their energy (8), `amplitudes_series` the same
equations for the Taylor method, `tangent` their linearisation along a solution, and `linear_flow`
the exact solution without the cubic terms.
"""
