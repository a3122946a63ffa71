"""Pack the project and its results into one file to deposit."""

from replication.archive import pack

from pendula import __version__
from pendula.sources import SCRIPTS


def pack_results(
    results: list[str], made_by: list[str], archive: str, checksum: str, configuration: dict
) -> None:
    """Write the archive of the project with `results`, and beside it its checksum.

    `made_by` names the code that made the results, `configuration` is what they were made with.
    """
    project = pack.Project(SCRIPTS.parent, "pendula", __version__)
    pack.pack_results(project, results, made_by, archive, checksum, configuration)
