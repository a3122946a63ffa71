"""All that forks take of the inside of Snakemake, which its interface for executors does not offer.

The tests run all of this, so that they tell what a new Snakemake has changed.
"""

from contextlib import nullcontext, suppress
from types import FunctionType, SimpleNamespace

from snakemake.benchmark import benchmarked
from snakemake.exceptions import SpawnedJobError
from snakemake.executors.local import Executor, run_wrapper
from snakemake.script import PythonScript, get_source, script
from snakemake.shell import shell
from snakemake.sourcecache import SourceCache

from snakemake_executor_plugin_forked.forks import (
    INTERRUPTED,
    EndedError,
    RefusedError,
    in_words,
)

UNASKED = 100, 1
"""Snakemake's own limit, where the user gives none: so many jobs may begin in so many seconds."""


class LocalExecutor(Executor):
    """Snakemake's own executor, except that it forks Python scripts from `self.forks`."""

    told = False

    def run_jobs(self, jobs):
        """Start jobs without Snakemake's limit of so many in a second, unless the user set one.

        The limit is meant for queues. For it, Snakemake looks for jobs anew a second after each
        time that it looked: n times a second after n jobs, and once more when all are done.
        """
        if self.forks.interrupted.is_set():
            raise SystemExit(INTERRUPTED)  # it is lost if Snakemake hears Ctrl-C while it logs
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

        def run(rule, *given):
            parts = {"shellcmd": None, "wrapper": None, "cwl": None, "script": rule.script}
            forked = SimpleNamespace(name=rule.name, run_func=self.with_forks(rule), **parts)
            try:
                run_wrapper(forked, *given)
            except SystemExit as end:  # what is wrong has been said, and Snakemake shall not
                raise SpawnedJobError from end

        return self.pool.submit(self.cached_or_run, job, run, *self.job_args_and_prepare(job))

    def with_forks(self, rule):
        """Return what runs a rule, with another function `script`."""

        def evaluate(path, basedir, *given):
            *others, cache, runtime_cache, paths = given
            _, _, params, wildcards, *_ = others
            place = str(path), SourceCache(cache, runtime_cache), basedir, wildcards, params
            found, source, language, local, cached = get_source(*place)
            if language != "python":
                return script(path, basedir, *given)
            one = ForkedScript(found, cached, source, basedir, *others, local, paths)
            one.executor = self
            return one.evaluate()

        run = rule.run_func
        names = {**run.__globals__, "script": evaluate}
        return FunctionType(run.__code__, names, run.__name__, run.__defaults__, run.__closure__)

    def print_job_error(self, job_info, msg=None, **others):
        """Tell that a job failed, unless the user has ended all."""
        if not self.forks.interrupted.is_set():
            super().print_job_error(job_info, msg, **others)

    def cancel(self):
        """End all jobs: Snakemake alone would wait for them."""
        self.forks.interrupted.set()
        self.forks.end(kindly=True)
        super().cancel()

    def shutdown(self):
        """End when all jobs have ended."""
        super().shutdown()
        self.forks.end()


class ForkedScript(PythonScript):
    """A Python script in a file, with all that Snakemake puts before it."""

    executor: LocalExecutor

    def execute_script(self, fname, edit=False):
        """Run the file as a fork, or as Snakemake does where this would not be the same."""
        forks, logger = self.executor.forks, self.executor.logger
        try:
            self.refuse_what_differs()
            pid, asked = forks.fork(fname, self.resources.get("tmpdir"))
            measured = self.bench_record is not None
            with asked, benchmarked(pid, self.bench_record) if measured else nullcontext():
                with suppress(BrokenPipeError):  # it was killed before it could begin
                    asked.sendall(b"go")
                status = int(forks.hear(asked))
            says = f"it {in_words(status)}" if status < 0 else ""
        except EndedError as error:
            status, says = 1, str(error)
        except RefusedError as error:
            if not self.executor.told:
                self.executor.told = True
                why = f"rule {self.rulename} starts a Python of its own, since {error}"
                logger.info(f"forked: {why}. Others may too, which is told once.")
            return super().execute_script(fname, edit)
        if status == INTERRUPTED:
            forks.interrupted.wait(1.0)  # Snakemake is about to hear what the job has heard
        if says and not forks.interrupted.is_set():
            logger.error(f"forked: rule {self.rulename} failed: {says}")
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
