"""What a person writes of a model, and the graph that it becomes.

`model` traces a function of the fields with `symbols`, whose operations make a `graph`;
`model_file` runs the file of a model, and `ends` has the boundary conditions.
"""
