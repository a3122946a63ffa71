"""A Snakemake executor for short Python scripts: jobs are forks of a process with all imports."""

from dataclasses import dataclass, field

from snakemake_interface_executor_plugins.settings import CommonSettings, ExecutorSettingsBase

from snakemake_executor_plugin_forked.forks import Forks
from snakemake_executor_plugin_forked.inside import Executor as Executor

common_settings = CommonSettings(
    non_local_exec=False,
    implies_no_shared_fs=False,
    job_deploy_sources=False,
    auto_deploy_default_storage_provider=False,
)
HELP = (
    "Modules that are imported before jobs are forked, in this order, separated by spaces. "
    "'package.*' means all modules of a package."
)


@dataclass
class ExecutorSettings(ExecutorSettingsBase):
    """The executor's options: `--forked-modules` on the command line or in a profile."""

    modules: str = field(default="", metadata={"help": HELP})

    def __post_init__(self) -> None:
        """Start the imports while Snakemake reads the workflow."""
        self.forks = Forks(self.modules.split())
