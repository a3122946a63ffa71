"""The paper's equations, each written once: what solvers, observables and checks need of them.

`equations` are (4) of the amplitudes and Newton's equations (1) as traced models. Their kernels are
in `amplitudes`, with the energy (8), and in `pendula`; `solvers` joins them to the methods of the
library, and `integrations` to its runs. Of (4) there are also the exact solution without the cubic
terms and Lemma 1 (`linear_chain`), the constants of Theorems 1 to 3 (`bounds`), and the steady
states of one pair (`pairs`).
"""
