"""The project's folders whose code enters the hashes of results."""

from pathlib import Path

from latticode.kernels.sources import ROOTS

SCRIPTS = Path(__file__).resolve().parent.parent
"""The folder of the replication's package and of the scripts of jobs."""

ROOTS.update(pendula=SCRIPTS, replication=SCRIPTS, benchmarks=SCRIPTS.parent)
