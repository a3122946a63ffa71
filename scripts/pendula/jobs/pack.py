"""Pack the project and its results into one file to deposit."""

from replication.archive import pack

from pendula import __version__
from pendula.sources import SCRIPTS


def pack_results(
    results: list[str], made_by: list[str], archive: str, checksum: str, configuration: dict
) -> None:
    """Write the archive of the project with `results`, and a file with its checksum.

    `made_by` lists the code that made the results with the `configuration`.
    """
    project = pack.Project(SCRIPTS.parent, "pendula", __version__)
    pack.pack_results(project, results, made_by, archive, checksum, configuration)
