"""Pack the project and its results into one file to deposit."""

import json
from pathlib import Path

from pendula.archive import codemeta, crate
from pendula.archive import configuration as settings
from pendula.archive.about import read_about
from pendula.archive.checksums import MANIFEST, line, manifest
from pendula.archive.contents import check_records, code_files
from pendula.archive.tarball import pack
from pendula.datasets.files import complete_or_absent
from pendula.sources import SCRIPTS

PROJECT = SCRIPTS.parent


def pack_results(
    results: list[str], records: list[str], archive: str, checksum: str, configuration: dict
) -> None:
    """Write the archive of the project with `results`, and beside it its checksum.

    `records` name the code that made the results, `configuration` is what they were made with.
    """
    about = read_about(PROJECT)
    code = code_files(PROJECT)
    check_records(map(Path, records), code)
    members = {name: PROJECT / name for name in code}
    members |= {name: Path(name) for name in (*results, *records)}
    members["configuration.yaml"] = settings.dump(configuration)
    members["codemeta.json"] = _json(codemeta.describe(about))
    members["ro-crate-metadata.json"] = _json(crate.describe(about, _sizes(members)))
    members[MANIFEST] = manifest(members)
    with complete_or_absent(archive) as new_archive, complete_or_absent(checksum) as new_checksum:
        pack(new_archive, f"{about.name}-{about.version}", members)
        new_checksum.write_text(line(Path(archive).name, new_archive), "utf-8")
    size = Path(archive).stat().st_size / 1e6
    print(f"{archive}: {len(members)} files, {size:.1f} MB")


def _sizes(members: dict[str, Path | bytes]) -> dict[str, int]:
    return {
        name: len(content) if isinstance(content, bytes) else content.stat().st_size
        for name, content in members.items()
    }


def _json(description: dict) -> bytes:
    return (json.dumps(description, indent=1, ensure_ascii=False) + "\n").encode()


if __name__ == "__main__":
    from job import run

    run(pack_results, snakemake)  # noqa: F821
