"""The equations, each written once: what solvers, observables and checks need of a model.

`amplitudes` holds the paper's equations (4) and their energy (8), `amplitudes_series` the same
equations for the Taylor method, `tangent` their linearisation along a solution, `linear_chain` the
exact solution without the cubic terms and Lemma 1, `bounds` the constants of Theorems 1 to 3,
`pairs` the steady states of one pair, `pendula` Newton's equations (1).
"""
