"""Does once what each job would do at its first use of a library; jobs are forks of what did it.

The process that jobs are forked from imports this: see profiles/default/profile.yaml.
"""

import numba
import xarray

import pendula.studies.paper.compile_solver  # noqa: F401, what the first jobs do

numba.njit("float64(float64)")(lambda x: x)  # numba gathers the functions that it knows
xarray.backends.list_engines()
