"""Models of lattices: equations written in Python, traced into a graph of operations.

`model` calls the equations with `symbols`, whose operations build a `graph`. `names` checks the
names of fields and parameters, and `model_file` runs the file of a model. `rate_properties` and
`rate_bounds` derive properties of the traced rates. `ends` defines the boundary conditions,
`couplings` the matrices between sites, and `initial_values` the problem to be integrated.
"""
