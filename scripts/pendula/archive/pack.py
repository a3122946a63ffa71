"""Pack the project and its results into one file to deposit."""

import json
from pathlib import Path

from pendula.datasets import complete_or_absent
from pendula.sources import SCRIPTS

from . import contents, metadata

PROJECT = SCRIPTS.parent


def pack_results(
    results: list[str], made_by: list[str], archive: str, checksum: str, configuration: dict
) -> None:
    """Write the archive of the project with `results`, and beside it its checksum.

    `made_by` names the code that made the results, `configuration` is what they were made with.
    """
    code = contents.code_files(PROJECT)  # first, for it names what is missing
    about = metadata.read_about(PROJECT)
    contents.check_code(made_by, code)
    members = {name: PROJECT / name for name in code}
    members |= {name: Path(name) for name in results}
    members["configuration.yaml"] = contents.dump_configuration(configuration)
    members["codemeta.json"] = _json(metadata.describe_software(about))
    members["ro-crate-metadata.json"] = _json(metadata.describe_archive(about, members))
    members[contents.MANIFEST] = contents.manifest(members)
    with complete_or_absent(archive) as new_archive, complete_or_absent(checksum) as new_checksum:
        contents.pack(new_archive, f"{about.name}-{about.version}", members)
        line = contents.checksum_line(Path(archive).name, new_archive)
        new_checksum.write_text(line, "utf-8")
    size = Path(archive).stat().st_size / 1e6
    print(f"{archive}: {len(members)} files, {size:.1f} MB")


def _json(description: dict) -> bytes:
    return (json.dumps(description, indent=1, ensure_ascii=False) + "\n").encode()
