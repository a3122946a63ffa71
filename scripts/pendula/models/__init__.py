"""The paper's equations, each written once: what solvers, observables and checks need of them.

`amplitudes` are the equations (4) and their energy (8), and `pendula` are Newton's equations (1).
Of (4) there are also the exact solution without the cubic terms and Lemma 1 (`linear_chain`), the
constants of Theorems 1 to 3 (`bounds`), and the steady states of one pair (`pairs`).
"""
