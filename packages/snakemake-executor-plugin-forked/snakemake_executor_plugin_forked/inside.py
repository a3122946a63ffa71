"""All that forks take of the inside of Snakemake, which its interface for executors does not offer.

The tests run all of this, so that they tell what a new Snakemake has changed.
"""

from copy import copy
from types import FunctionType

import snakemake.executors.local
from snakemake.benchmark import benchmarked
from snakemake.exceptions import SpawnedJobError
from snakemake.script import PythonScript, script
from snakemake.shell import shell

from snakemake_executor_plugin_forked.forks import INTERRUPTED, RefusedError, in_words

UNASKED = 100, 1
"""Snakemake's own limit, where the user gives none: so many jobs may begin in so many seconds."""


def with_names(function, **names):
    """Return a function that finds other things under these names."""
    names = {**function.__globals__, **names}
    return FunctionType(
        function.__code__, names, function.__name__, function.__defaults__, function.__closure__
    )


class Executor(snakemake.executors.local.Executor):
    """Snakemake's own executor for jobs on this machine, except that it forks Python scripts."""

    told = False

    def __post_init__(self):
        """Have Python scripts run by forks."""
        super().__post_init__()
        self.forks = self.executor_settings.forks
        forked = type("Forked", (ForkedScript,), {"executor": self})
        self.script = with_names(script, PythonScript=forked)

    def run_jobs(self, jobs):
        """Start jobs without Snakemake's limit of so many in a second, unless the user set one.

        The limit is meant for queues. For it, Snakemake looks for jobs anew a second after each
        time that it looked: n times a second after n jobs, and once more when all are done.
        """
        if self.forks.interrupted:
            raise SystemExit(INTERRUPTED)  # it is lost if Snakemake hears Ctrl-C while it logs
        self.forks.begin()
        scheduler = self.workflow.scheduler
        limiter = scheduler.job_rate_limiter
        if limiter and (limiter.max_jobs, limiter.timespan) == UNASKED:
            scheduler.job_rate_limiter = None
            scheduler.resources["_job_count"] = scheduler.global_resources["_job_count"]
        super().run_jobs(jobs)

    def run_single_job(self, job):
        """Start a job, and return the future of its end."""
        if not job.is_script or job.is_shadow or job.pipe_group:
            return super().run_single_job(job)
        given = self.job_args_and_prepare(job)
        return self.pool.submit(self.cached_or_run, job, self.run_script, *given)

    def run_script(self, rule, *given):
        """Run a job with another function for its script."""
        rule = copy(rule)
        rule.run_func = with_names(rule.run_func, script=self.script)
        try:
            snakemake.executors.local.run_wrapper(rule, *given)
        except SystemExit as end:  # what is wrong has been said, and Snakemake shall not
            raise SpawnedJobError from end

    def print_job_error(self, job_info, msg=None, **others):
        """Tell that a job failed, unless the user has ended all."""
        if not self.forks.interrupted:
            super().print_job_error(job_info, msg, **others)

    def cancel(self):
        """End all jobs: Snakemake alone would wait for them."""
        self.forks.interrupted = True
        self.forks.end()
        super().cancel()

    def shutdown(self):
        """End when all jobs have ended."""
        super().shutdown()
        self.forks.end()


class ForkedScript(PythonScript):
    """A Python script in a file, with all that Snakemake puts before it."""

    executor: Executor

    def execute_script(self, fname, edit=False):
        """Run the file as a fork, or as Snakemake does where this would not be the same."""
        forks, logger = self.executor.forks, self.executor.logger
        try:
            self.refuse_what_differs()
            job = forks.fork(fname, self.resources.get("tmpdir"))
            measured = benchmarked(self.bench_record is not None and job.pid, self.bench_record)
            with job.socket, measured:
                job.socket.shutdown(1)  # so that it begins
                if not 0 <= (status := int(forks.hear(job))) <= 1:
                    raise ChildProcessError(f"it {in_words(status)}")
        except ChildProcessError as error:
            status = 1
            if not forks.interrupted:
                logger.error(f"forked: rule {self.rulename} failed: {error}")
        except RefusedError as error:
            if not self.executor.told:
                self.executor.told = True
                why = f"rule {self.rulename} starts a Python of its own, since {error}"
                logger.info(f"forked: {why}. Others may too, which is told once.")
            return super().execute_script(fname, edit)
        if status:
            raise SystemExit(status)

    def refuse_what_differs(self):
        """Refuse a job whose command would not be Python and the file, or of several threads."""
        around = shell._get_process_prefix() + shell._process_suffix
        if self.threads != 1:
            raise RefusedError(f"it has {self.threads} threads")
        if self.conda_env or self.container_img or self.env_modules:
            raise RefusedError("it has an environment of its own")
        if self.resources.get("shell_exec") or around not in ("", "set -euo pipefail; "):
            raise RefusedError("the workflow changes how commands are run")
