"""Functions, matrices and draws with the same bits on every machine.

The functions of the C library, BLAS, LAPACK and NumPy's vector code round otherwise on another
processor. What is here takes + - * / and square roots alone, in one order, which all round alike.
"""
