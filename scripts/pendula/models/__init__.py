"""The equations, each written once: what solvers, observables and checks need of a model.

`chain` holds what all models share: the state, its ends and the walk over its sites; `series` holds
the same for power series. `generated` writes the kernels of a traced model (see pendula.model).
`amplitudes` are the paper's equations (4) and their energy (8), and `pendula` are Newton's
equations (1). Of (4) there are also the linearisation along a solution (`tangent`), the exact
solution without the cubic terms and Lemma 1 (`linear_chain`), the constants of Theorems 1 to 3
(`bounds`), and the steady states of one pair (`pairs`).
"""
