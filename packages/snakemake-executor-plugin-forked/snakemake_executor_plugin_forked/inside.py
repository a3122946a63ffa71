"""Code that uses private parts of Snakemake, because the executor interface is not sufficient.

The tests exercise all of it, so they fail if a new Snakemake version changes these parts.
"""

from concurrent.futures import Future
from copy import copy
from types import FunctionType
from typing import Any

import snakemake.executors.local
from snakemake.benchmark import benchmarked
from snakemake.exceptions import SpawnedJobError
from snakemake.script import PythonScript, script
from snakemake.shell import shell

from snakemake_executor_plugin_forked.forks import INTERRUPTED, CannotForkError, describe_end

DEFAULT_LIMIT = 100, 1
"""Snakemake's default limit: the number of jobs that may start, within this time in seconds."""


def with_names(function: FunctionType, **names: Any) -> FunctionType:
    """Return a copy of a function with other values of these global names."""
    names = {**function.__globals__, **names}
    return FunctionType(
        function.__code__, names, function.__name__, function.__defaults__, function.__closure__
    )


class Executor(snakemake.executors.local.Executor):
    """Snakemake's local executor, except that Python scripts run as forks."""

    fallback_reported = False

    def __post_init__(self) -> None:
        """Replace Snakemake's way of running Python scripts by forks."""
        super().__post_init__()
        self.forks = self.executor_settings.forks
        forked = type("Forked", (ForkedScript,), {"executor": self})
        self.script = with_names(script, PythonScript=forked)

    def run_jobs(self, jobs: list[Any]) -> None:
        """Start jobs without Snakemake's default limit of jobs per second.

        This limit is for queues. With it, each check for new jobs schedules another check
        one second later: after n jobs there are n checks per second, and one after the last job.
        """
        if self.forks.interrupted:
            raise SystemExit(INTERRUPTED)  # Snakemake loses a Ctrl-C that comes while it logs
        self.forks.begin()
        scheduler = self.workflow.scheduler
        limiter = scheduler.job_rate_limiter
        if limiter and (limiter.max_jobs, limiter.timespan) == DEFAULT_LIMIT:
            scheduler.job_rate_limiter = None
            scheduler.resources["_job_count"] = scheduler.global_resources["_job_count"]
        super().run_jobs(jobs)

    def run_single_job(self, job: Any) -> Future:
        """Start a job, and return its future."""
        if not job.is_script or job.is_shadow or job.pipe_group:
            return super().run_single_job(job)
        arguments = self.job_args_and_prepare(job)
        return self.pool.submit(self.cached_or_run, job, self.run_script, *arguments)

    def run_script(self, rule: Any, *arguments: Any) -> None:
        """Run a job with a Python script."""
        rule = copy(rule)
        rule.run_func = with_names(rule.run_func, script=self.script)
        try:
            snakemake.executors.local.run_wrapper(rule, *arguments)
        except SystemExit as end:  # the script printed the reason, so Snakemake adds none
            raise SpawnedJobError from end

    def print_job_error(self, job_info: Any, msg: str | None = None, **options: Any) -> None:
        """Report that a job failed, unless the user has interrupted the run."""
        if not self.forks.interrupted:
            super().print_job_error(job_info, msg, **options)

    def cancel(self) -> None:
        """End all jobs: Snakemake itself would wait for them."""
        self.forks.interrupted = True
        self.forks.end()
        super().cancel()

    def shutdown(self) -> None:
        """Wait for all jobs, then end."""
        super().shutdown()
        self.forks.end()


class ForkedScript(PythonScript):
    """A Python script in a file, preceded by Snakemake's preamble."""

    executor: Executor

    def execute_script(self, fname: str, edit: bool = False) -> None:
        """Run the file as a fork, or in a new process if a fork would not be equivalent."""
        forks, logger = self.executor.forks, self.executor.logger
        try:
            self.check_that_a_fork_is_the_same()
            job = forks.fork(fname, self.resources.get("tmpdir"))
            measured = benchmarked(self.bench_record is not None and job.pid, self.bench_record)
            with job.socket, measured:
                job.socket.shutdown(1)  # the signal to begin
                if not 0 <= (status := int(forks.receive(job))) <= 1:
                    raise ChildProcessError(f"it {describe_end(status)}")
        except ChildProcessError as error:
            status = 1
            if not forks.interrupted:
                logger.error(f"forked: rule {self.rulename} failed: {error}")
        except CannotForkError as error:
            if not self.executor.fallback_reported:
                self.executor.fallback_reported = True
                why = f"rule {self.rulename} runs in a separate Python process because {error}"
                logger.info(f"forked: {why}. Other rules may too; this is reported only once.")
            return super().execute_script(fname, edit)
        if status:
            raise SystemExit(status)

    def check_that_a_fork_is_the_same(self) -> None:
        """Raise CannotForkError for a job with several threads, its own environment or command."""
        prefix_and_suffix = shell._get_process_prefix() + shell._process_suffix
        if self.threads != 1:
            raise CannotForkError(f"it has {self.threads} threads")
        if self.conda_env or self.container_img or self.env_modules:
            raise CannotForkError("it has its own environment")
        if self.resources.get("shell_exec") or prefix_and_suffix not in ("", "set -euo pipefail; "):
            raise CannotForkError("the workflow changes how shell commands are run")
