"""Models of lattices: equations written in Python, traced into a graph of operations.

`model` calls the equations with `symbols`, whose operations build a `graph`. `model_file` runs the
file of a model, `ends` defines the boundary conditions, `couplings` the matrices between sites, and
`initial_values` the problem to be integrated.
"""
