"""Archive of the project and its results for a repository, as a Workflow RO-Crate 1.0.

The same files give the same bytes, and so the same checksum. The library rocrate would write the
current time and random identifiers. We therefore set the date of the release, and an identifier for
each entity.
"""

import gzip
import hashlib
import io
import json
import re
import tarfile
from pathlib import Path
from typing import NamedTuple
from urllib.parse import quote

import yaml
from latticode.datasets import complete_or_absent
from latticode.datasets.netcdf import read
from latticode.kernels.sources import digest_of
from rocrate.model import ContextEntity
from rocrate.rocrate import ROCrate

from .contents import MANIFEST, ArchiveError, code_files

PACKED_TIME = 315532800
"""The time of all files, 1980-01-01. With different times Snakemake would remake some files."""

FORMATS = {".nc": "application/netcdf", ".png": "image/png", ".pdf": "application/pdf"}
FORMATS |= {".html": "text/html", ".md": "text/markdown", ".json": "application/json"}


class AliasFreeDumper(yaml.SafeDumper):
    """A YAML writer without aliases, so that users can edit one of several equal values."""

    def ignore_aliases(self, data: object) -> bool:
        return True


class Project(NamedTuple):
    """A project to pack: its folder, and the name and the version of its release."""

    folder: Path
    name: str
    version: str


def pack_results(
    project: Project,
    results: list[str],
    made_by: list[str],
    archive: str,
    checksum: str,
    configuration: dict,
) -> None:
    """Write the archive of the project with `results`, and a file with the archive's checksum.

    `made_by` lists the code files that made the results with this `configuration`.
    """
    code = code_files(project.folder)  # first, because it reports missing files
    if left := sorted(set(made_by) - set(code)):
        raise ArchiveError(f"{left[0]} made these results but is not tracked: `git add` it")
    members = {name: project.folder / name for name in code} | {
        name: Path(name) for name in results
    }
    crate = json.dumps(describe(project, members), indent=1, ensure_ascii=False)
    words = yaml.dump(configuration, Dumper=AliasFreeDumper, allow_unicode=True)
    with complete_or_absent(archive) as new_archive, complete_or_absent(checksum) as new_checksum:
        new = {"ro-crate-metadata.json": f"{crate}\n", "configuration.yaml": words}
        count = pack(new_archive, f"{project.name}-{project.version}", members, new)
        new_checksum.write_text(f"{digest_of(new_archive)}  {Path(archive).name}\n", "utf-8")
    print(f"{archive}: {count} files, {Path(archive).stat().st_size / 1e6:.1f} MB")


def pack(archive: Path, folder: str, files: dict[str, Path], texts: dict[str, str]) -> int:
    """Write files, texts and a manifest of their checksums below `folder`; return their number."""
    data = {name: path.read_bytes() for name, path in files.items()}
    data |= {name: text.encode() for name, text in texts.items()}
    lines = (f"{hashlib.sha256(data[name]).hexdigest()}  {name}\n" for name in sorted(data))
    data[MANIFEST] = "".join(lines).encode()
    with (
        open(archive, "wb") as raw,
        # The compressed bytes also depend on zlib. Level 9 would take twice as long to save 0.2 %.
        gzip.GzipFile("", "wb", 6, raw, mtime=PACKED_TIME) as zipped,
        tarfile.open(mode="w", fileobj=zipped, format=tarfile.USTAR_FORMAT) as tar,
    ):
        for name, content in sorted(data.items()):
            runs = name in files and files[name].stat().st_mode & 0o100
            entry = tarfile.TarInfo(f"{folder}/{name}")  # without an owner
            entry.size, entry.mtime, entry.mode = (
                len(content),
                PACKED_TIME,
                0o755 if runs else 0o644,
            )
            tar.addfile(entry, io.BytesIO(content))
    return len(data)


def describe(project: Project, members: dict[str, Path]) -> dict:
    """Return ro-crate-metadata.json: the workflow, its authors and citation, and each result.

    The metadata come from CITATION.cff, LICENSE-DATA and environment.txt of the project.
    """
    cited = yaml.safe_load((project.folder / "CITATION.cff").read_text("utf-8"))
    pinned = (project.folder / "environment.txt").read_text("utf-8")
    crate = ROCrate(version="1.1")

    def entity(identifier: str, kind: str, name: str) -> ContextEntity:
        properties = {"@type": kind, "name": name}
        return crate.add(ContextEntity(crate, identifier, properties=properties))

    rights = [cited["license"], (project.folder / "LICENSE-DATA").read_text("utf-8").split()[1]]
    of_code, of_data = (
        entity(f"https://spdx.org/licenses/{name}", "CreativeWork", name) for name in rights
    )
    authors = [
        ("Organization", author["name"])
        if "name" in author
        else ("Person", f"{author['given-names']} {author['family-names']}")
        for author in cited["authors"]
    ]
    facts = {
        "name": cited["title"],
        "version": project.version,
        "author": [entity(f"#{name.replace(' ', '-')}", kind, name) for kind, name in authors],
        "license": of_code,
    }
    paper = cited["references"][0]
    of_root = {
        "description": f"{cited['title']}: code, environment, datasets and figures",
        "datePublished": str(cited["date-released"]),
        "citation": entity(f"https://doi.org/{paper['doi']}", "ScholarlyArticle", paper["title"]),
    }
    for key, value in (facts | of_root).items():
        crate.root_dataset[key] = value
    (release,) = re.findall(r"^snakemake==(\S+)", pinned, re.MULTILINE)
    language = {"lang": "snakemake", "lang_version": release}
    crate.add_workflow(dest_path="Snakefile", main=True, properties=facts, **language)
    crate.add_file(dest_path="README.md", properties={"about": {"@id": "./"}})
    for name in sorted(name for name in members if name.startswith("results/")):
        crate.add_file(dest_path=name, properties={**_facts_of(name, members), "license": of_data})
    return crate.metadata.generate()


def _facts_of(name: str, members: dict[str, Path]) -> dict:
    """Return the metadata of a result: for a dataset its title, for a figure its dataset."""
    path, data = members[name], Path(name).with_suffix(".nc").as_posix()
    facts = {"name": path.name, "encodingFormat": FORMATS.get(path.suffix, "text/plain")}
    if path.suffix == ".nc":
        facts["description"] = read(path).attrs["title"]
    elif data in members:
        facts["isBasedOn"] = {"@id": quote(data)}
    return facts
