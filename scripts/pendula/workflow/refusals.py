"""Checks that stop Snakemake before its first job, with the reason and what to do."""

import os
import sys
from collections.abc import Callable, Iterable
from functools import wraps
from pathlib import Path
from tempfile import TemporaryFile
from typing import Any, NoReturn

from latticode.configuration.files import ConfigurationError
from snakemake.logging import logger
from snakemake.settings.enums import Quietness

from .slurm_requests import partitions_of_slurm, requests_above_limits

BYTES_OF_METADATA = 100_000
"""Snakemake's records of a run take at least this."""


class Refusals:
    """Checks of a call of a workflow; each logs the reason and exits with status 1 if it fails."""

    def __init__(self, workflow: Any) -> None:
        self.workflow = workflow

    def stop(self, reason: Any) -> NoReturn:
        """Log the reason and exit with status 1.

        For an exception Snakemake would also print where in the rules it was raised.
        """
        if Quietness.ALL in self.workflow.output_settings.quiet:  # which hides errors too
            print(reason, file=sys.stderr)
        logger.error(str(reason))
        raise SystemExit(1)

    def stopping(self, function: Callable) -> Callable:
        """Return `function` wrapped: if it raises ConfigurationError, the workflow stops."""

        @wraps(function)
        def checked(*arguments: Any, **settings: Any) -> Any:
            try:
                return function(*arguments, **settings)
            except ConfigurationError as error:
                self.stop(error)

        return checked

    def refuse_other_copies(self, project: Path, package: Any) -> None:
        """Stop if the installed packages are those of another copy of the project."""
        installed = Path(package.__file__).resolve()
        if not installed.is_relative_to(project.resolve()):
            self.stop(
                f"Python imports the project from {installed.parents[2]}, not from this copy: run "
                f"`pip install -e {project}` in a separate environment"
            )

    def refuse_storage(self) -> None:
        """Stop if a default storage is set, for which Snakemake 9.27 ignores pathvars of rules."""
        if provider := self.workflow.storage_settings.default_storage_provider:
            self.stop(
                f"--default-storage-provider {provider} is not supported here, because with it "
                "Snakemake ignores the pathvars of rules. Leave it out, and copy results/ to the "
                "storage afterwards"
            )

    def refuse_read_only_folder(self) -> None:
        """Stop if Snakemake cannot write its records in the working directory."""
        for folder in filter(os.path.exists, (".", ".snakemake")):
            if not os.access(folder, os.W_OK):
                self.stop(
                    f"{os.path.abspath(folder)} is read-only, but Snakemake writes its metadata "
                    "there even in a dry run: pass a writable folder with --directory"
                )

    def refuse_full_disk(self) -> None:
        """Stop if the disk of the working directory has no room for the records of a run."""
        if not self.workflow.is_main_process or self.workflow.dryrun:
            return
        try:
            with TemporaryFile(dir=".") as probe:
                probe.write(bytes(BYTES_OF_METADATA))
                probe.flush()
        except OSError as error:
            folder = os.path.abspath(".")
            self.stop(
                f"cannot write to {folder} ({error.strerror}): free some space, and run again"
            )

    def refuse_read_only_results(self) -> None:
        """Stop before the first job if a file of the run would lie in a read-only folder."""
        jobs = list(self.workflow.dag.needrun_jobs())
        files = (file for job in jobs for file in (*job.output, *job.log))
        for folder in read_only_folders(files):
            self.stop(f"{folder} is read-only: make it writable, or give another by --directory")

    def refuse_endless_requests(self) -> None:
        """Stop before the first job if a job would never leave Slurm's queue."""
        settings = self.workflow.executor_settings
        if os.environ.get("SNAKEMAKE_SLURM_PARTITIONS") or settings.partition_config:
            return  # the plugin chooses partitions
        requests = [
            (job.rule.name, job.resources.get("slurm_partition"), job.resources.get("runtime"))
            for job in self.workflow.dag.needrun_jobs()
        ]
        if reasons := requests_above_limits(requests, partitions_of_slurm()):
            self.stop("\n".join(reasons))


def read_only_folders(files: Iterable[str]) -> list[Path]:
    """Return the read-only folders among the nearest existing ones above each of `files`."""
    parents = {Path(file).absolute().parent for file in files}
    existing = {
        next(folder for folder in (parent, *parent.parents) if folder.exists())
        for parent in parents
    }
    return sorted(folder for folder in existing if not os.access(folder, os.W_OK))
