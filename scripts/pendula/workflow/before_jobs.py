"""First uses of libraries, done once in the process that jobs are forked from.

That process imports this module: see profiles/default/profile.yaml.
"""

import numba
import xarray

import pendula.studies.paper.compile_solver  # noqa: F401, the first jobs need it

numba.njit("float64(float64)")(lambda x: x)  # numba builds its tables of known functions
xarray.backends.list_engines()
