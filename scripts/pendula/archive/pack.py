"""Pack the project and its results into one file to deposit."""

import json
from pathlib import Path

from pendula import __version__
from pendula.datasets import complete_or_absent
from pendula.sources import SCRIPTS

from . import contents
from .metadata import describe_archive

PROJECT = SCRIPTS.parent


def pack_results(
    results: list[str], made_by: list[str], archive: str, checksum: str, configuration: dict
) -> None:
    """Write the archive of the project with `results`, and beside it its checksum.

    `made_by` names the code that made the results, `configuration` is what they were made with.
    """
    code = contents.code_files(PROJECT)  # first, for it names what is missing
    contents.check_code(made_by, code)
    members = {name: PROJECT / name for name in code}
    members |= {name: Path(name) for name in results}
    members["configuration.yaml"] = contents.dump_configuration(configuration)
    crate = json.dumps(describe_archive(PROJECT, members), indent=1, ensure_ascii=False)
    members["ro-crate-metadata.json"] = f"{crate}\n".encode()
    members[contents.MANIFEST] = contents.manifest(members)
    with complete_or_absent(archive) as new_archive, complete_or_absent(checksum) as new_checksum:
        contents.pack(new_archive, f"pendula-{__version__}", members)
        line = contents.checksum_line(Path(archive).name, new_archive)
        new_checksum.write_text(line, "utf-8")
    size = Path(archive).stat().st_size / 1e6
    print(f"{archive}: {len(members)} files, {size:.1f} MB")
