"""The paper's equations, each written once, with their kernels, bounds and exact solutions.

`equations`      (4) of the amplitudes and Newton's equations (1), as traced models
`amplitudes`     kernels of (4), and the energy (8)
`pendula`        kernels of (1), and their drive
`solvers`        the library's methods with these kernels
`integrations`   how the library's runs use these kernels
`linear_chain`   (4) without the cubic terms: the exact solution, and Lemma 1
`bounds`         Theorems 1 to 3 with their constants
`pairs`          the steady states of one pair; `steady` continues them to a chain
"""
