import os  # noqa: F401
import sys  # noqa: F401
import time  # noqa: F401

exec(snakemake.params.do)  # noqa: F821
open(snakemake.output[0], "w").close()  # noqa: F821
