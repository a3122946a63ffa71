"""Elementary functions, matrix products and random numbers with the same bits on every machine.

The C library, BLAS, LAPACK and NumPy's vectorised functions round differently on different
processors. The functions of this package use only + - * / and square roots, in a fixed order.
IEEE 754 rounds these identically everywhere.
"""
