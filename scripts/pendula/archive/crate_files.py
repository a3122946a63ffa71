"""The files of an archive for its RO-Crate: what each is, by its place and its ending."""

from fnmatch import fnmatchcase
from pathlib import PurePosixPath
from urllib.parse import quote

FORMATS = {
    ".nc": "application/netcdf",
    ".png": "image/png",
    ".pdf": "application/pdf",
    ".html": "text/html",
    ".md": "text/markdown",
    ".json": "application/json",
    ".yaml": "application/yaml",
    ".toml": "application/toml",
    ".cff": "application/yaml",
}
PLACES = {  # the first pattern that fits; what fits none is described by its folder
    "results/trajectories/*": "Norms and energy of a case against time, by one solver",
    "results/sweeps/*": "Norms of a case over half-widths of the chain",
    "results/checks/*": "Numbers on the paper's theory, and on what can be trusted",
    "results/unbounded/*": "The chain without ends",
    "results/figures/*.nc": "The data that a figure shows",
    "results/figures/*": "A figure",
    "results/tables/*": "A table",
    "results/truth/*": "A verified trajectory, from multiprecision arithmetic",
    "results/kept/*": "What the report shows of the measured speed",
    "results/code/*": "Record of the code that a job depends on, with checksums",
    "results/kernels/*": "Mark that a solver was compiled",
    "results/report.html": "The report: all figures, numbers and verdicts on one page",
    "results/claims.json": "The paper's claims, with a verdict on each",
    "results/*": "A result",
    "README.md": "What this is, how to run it, what comes out",
    "ARCHITECTURE.md": "How the parts fit together",
    "CHANGELOG.md": "What changed from version to version",
    "CITATION.cff": "How to cite this work, and the paper that it replicates",
    "LICENSE": "The license",
    "environment.txt": "The exact versions of all packages",
    "configuration.yaml": "The configuration that these results were made with",
    "codemeta.json": "The software in the words of CodeMeta",
}
FOLDERS = {
    "config/": "The paper's cases and sweeps",
    "profiles/": "How Snakemake runs: here, and on a cluster",
    "scripts/": "The library, and one script a rule",
    "tests/": "The tests, and the accepted results",
    "workflow/": "The rules of the workflow, and its environments",
}


def describe_files(sizes: dict[str, int]) -> list[dict]:
    """Return an entity for each result and each file of the top folder, and one a code folder."""
    places = [(name, place) for name in sorted(sizes) if (place := _place(name))]
    files = [_file(name, place, sizes) for name, place in places]
    found = {f"{name.split('/')[0]}/" for name in sizes if "/" in name}
    return files + [_folder(name, FOLDERS[name]) for name in FOLDERS if name in found]


def _place(name: str) -> str | None:
    return next((text for pattern, text in PLACES.items() if fnmatchcase(name, pattern)), None)


def _file(name: str, place: str, sizes: dict[str, int]) -> dict:
    path = PurePosixPath(name)
    entity = {
        "@id": quote(name),
        "@type": "File",
        "name": path.name,
        "description": place,
        "encodingFormat": FORMATS.get(path.suffix, "text/plain"),
        "contentSize": str(sizes[name]),
    }
    if name == "README.md":
        entity["about"] = {"@id": "./"}
    data = path.with_suffix(".nc").as_posix()
    if path.suffix in (".png", ".pdf") and data in sizes:
        entity["isBasedOn"] = {"@id": quote(data)}
    return entity


def _folder(name: str, text: str) -> dict:
    return {"@id": name, "@type": "Dataset", "name": name, "description": text}
