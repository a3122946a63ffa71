"""What was measured on: processor, versions; and what the processor could do at best."""

import platform
from importlib.metadata import version
from pathlib import Path


def describe() -> dict[str, str]:
    """Return the processor's name and the versions that matter, for people who compare times."""
    return {
        "processor": _processor(),
        "python": platform.python_version(),
        **{name: version(name) for name in ("numpy", "numba", "scipy")},
    }


def _processor() -> str:
    information = Path("/proc/cpuinfo")
    if information.exists():
        for line in information.read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    return platform.processor() or platform.machine()
