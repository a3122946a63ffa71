"""How the run was made: versions, processor, hashes of what went in, and times of the rules."""

import hashlib
import platform
from importlib.metadata import version
from pathlib import Path
from typing import Any

from llvmlite import binding

from pendula.sources import describe_machine

from .results import Results

PACKAGES = ("snakemake", "xarray", "netCDF4", "matplotlib", "pydantic", "Jinja2", "pillow")
VECTORS = ("sse", "avx", "fma", "neon", "sve")
SHOWN = 16  # digits of a hash that are shown


def gather(results: Results, inputs: list[str], settings: str, logs: str, took: str) -> dict:
    """Return what a reader needs to repeat the run.

    `inputs` are links to the files that went in, `settings` the configuration as text; each log
    below the folder `logs` ends with a line that begins with `took`. Only `times` differ between
    two runs.
    """
    times = run_times(Path(logs), took)
    return {
        "versions": [[name, value] for name, value in versions().items()],
        "features": ", ".join(features()),
        "system": platform.system(),
        "hashes": [_hashed(results, link) for link in inputs],
        "settings": digest(settings.encode()),
        "times": [[name, f"{seconds:.1f}"] for name, seconds in times],
        "total": f"{sum(seconds for _, seconds in times):.0f}",
    }


def versions() -> dict[str, str]:
    """Return the processor and the versions of the packages that the numbers pass through."""
    return describe_machine() | {name: version(name) for name in PACKAGES}


def features() -> list[str]:
    """Return the vector instructions that compiled kernels can use here."""
    found = binding.get_host_cpu_features()
    return sorted(name for name, there in found.items() if there and name.startswith(VECTORS))


def run_times(logs: Path, took: str) -> list[tuple[str, float]]:
    """Return the wall time of each job whose log tells it, the longest first."""
    found = []
    for log in sorted(logs.rglob("*.log")):
        last = log.read_text(encoding="utf-8", errors="replace").rstrip().rpartition("\n")[2]
        if last.startswith(took):
            name = log.relative_to(logs).with_suffix("").as_posix()
            found.append((name, float(last.removeprefix(took).split()[0])))
    return sorted(found, key=lambda job: (-job[1], job[0]))


def digest(content: bytes) -> str:
    """Return the beginning of the SHA-256 of some content."""
    return hashlib.sha256(content).hexdigest()[:SHOWN]


def _hashed(results: Results, link: str) -> list[Any]:
    return [results.say(link, link), digest(results.path(link).read_bytes())]
