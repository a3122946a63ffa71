"""Run the function of one job in a Python session, with the arguments that its rule gives.

    >>> from pendula.workflow.debug import job
    >>> threshold = job("results/pendula/threshold.nc")
    >>> threshold.arguments["mus"]
    >>> variables, attributes = threshold.call()

Use it to run the job in a debugger, a profiler or a notebook.
"""

import os
import pickle
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from types import SimpleNamespace
from typing import Any, NamedTuple

from latticode.simulation.runs import ManyRuns

from pendula.contract.arguments import function_of, gather_for, load_arguments
from pendula.contract.kinds import KINDS
from pendula.sources import SCRIPTS

SNAKEFILE = """
include: {snakefile!r}
def plain(entry):
    return str(entry) if isinstance(entry, str) else list(map(str, entry))
def values_of(place):
    return {{name: plain(getattr(place, name)) for name in place.keys()}}
def keep_job():
    import pickle
    for job in [job for job in workflow.dag.jobs if {target!r} in job.output]:
        absent = [str(path) for path in job.input if not os.path.exists(path)]
        params = {{}} if absent else dict(job.params.items())
        places = values_of(job.input), params, values_of(job.output)
        with open({file!r}, "wb") as file:
            pickle.dump((absent, job.rule.name, str(job.rule.script), *places), file)
atexit.register(keep_job)
"""
"""A workflow that plans a job, and pickles the job's values when Snakemake exits."""


class Job(NamedTuple):
    """A job of the workflow: its rule, the function that it calls, and the loaded arguments."""

    rule: str
    function: Callable
    arguments: dict[str, Any]
    draw: Callable | None = None

    def call(self) -> Any:
        """Return the result of the function after all runs of a study, or the drawn figure.

        No file is written, unless the function itself writes one.
        """
        result = self.function(**self.arguments)
        if isinstance(result, ManyRuns):
            return result.make()
        return self.draw(result) if self.draw else result


def job(target: str, *options: str) -> Job:
    """Return the job that writes a file, such as results/checks/lyapunov.nc.

    `options` are those of Snakemake, such as "--configfile", "mine.yaml". Raises ValueError if no
    rule writes the file, with Snakemake's reason, and FileNotFoundError if an input is missing.
    """
    absent, rule, script, inputs, params, outputs = _planned(target, options)
    if absent:
        raise FileNotFoundError(f"{target} needs {absent[0]}: type `snakemake {absent[0]}` first")
    function, draw = function_of(params["call"]), None
    if script.endswith("figure.py"):
        function, draw = gather_for(function), function
    outputs = outputs if script.endswith("call.py") else {}
    values = SimpleNamespace(rule=rule, input=inputs, params=params, output=outputs)
    return Job(rule, function, load_arguments(function, values, KINDS).values, draw)


def _planned(target: str, options: tuple[str, ...]) -> tuple:
    """Return missing inputs, rule, script, inputs, params and outputs of a planned job."""
    with TemporaryDirectory() as folder:
        file, snakefile = Path(folder, "job"), Path(folder, "Snakefile")
        values = {"snakefile": str(SCRIPTS.parent / "Snakefile"), "target": target}
        snakefile.write_text(SNAKEFILE.format(**values, file=str(file)), encoding="utf-8")
        command = [sys.executable, "-m", "snakemake", target, "--dry-run", "--quiet", "rules"]
        where = ["--snakefile", str(snakefile), "--directory", os.getcwd(), "--cores", "1"]
        done = subprocess.run([*command, *where, *options], capture_output=True, text=True)
        if not file.exists():
            reason = (done.stdout + done.stderr).strip()
            raise ValueError(f"Snakemake plans no job for {target}: {reason}")
        return pickle.loads(file.read_bytes())
