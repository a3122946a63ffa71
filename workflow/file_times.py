"""When each result was written, kept beside the results for copies that lose it.

Snakemake makes a file again that is older than what it is made from. `cp -r` gives every file the
time at which it was copied, so that in the copy some results seem older than their inputs. For this
reason a run ends by writing the times and the digests of all results into a file, and gives this
file the time of the newest result. Where the file has another time, it was copied: then every
result that still has its digest gets its time back. So a copy reruns what its original would have
rerun.
"""

import hashlib
import json
import os
from contextlib import suppress
from pathlib import Path

from pendula.datasets import DatasetError, complete_or_absent

KEPT = "logs/file_times.json"
"""The file, below the folder of the results."""


def keep(results: Path) -> None:
    """Write down the time and the digest of every result, if there are results.

    A full disk fails nothing here: the results are made already, and only a copy lacks their times.
    """
    known, found = _recall(results), {}
    for path in sorted(results.rglob("*")):
        name, logs = path.relative_to(results).as_posix(), (results / KEPT).parent
        if path.is_file() and not path.name.startswith(".") and logs not in path.parents:
            time = path.stat().st_mtime_ns
            unchanged = known.get(name, {}).get("time") == time
            digest = known[name]["digest"] if unchanged else _digest(path)
            found[name] = {"time": time, "digest": digest}
    if found and (found != known or _is_copy(results, known)):
        with suppress(OSError, DatasetError):
            with complete_or_absent(results / KEPT) as partial:
                partial.write_text(json.dumps(found, indent=0), encoding="utf-8")
            _stamp(results, found)


def restore(results: Path) -> None:
    """Give the results of a copy their times back; where they may not be written, do nothing."""
    known = _recall(results)
    if known and _is_copy(results, known):
        with suppress(OSError):
            for name, entry in known.items():
                path = results / name
                if path.is_file() and _digest(path) == entry["digest"]:
                    os.utime(path, ns=(entry["time"], entry["time"]))
            _stamp(results, known)


def _recall(results: Path) -> dict[str, dict]:
    """Return what was kept, nothing where it is missing or damaged."""
    with suppress(OSError, ValueError, AttributeError, TypeError, KeyError):
        kept = json.loads((results / KEPT).read_text(encoding="utf-8")).items()
        return {name: {"time": one["time"] + 0, "digest": one["digest"]} for name, one in kept}
    return {}


def _is_copy(results: Path, known: dict[str, dict]) -> bool:
    return (results / KEPT).stat().st_mtime_ns != _newest(known)


def _stamp(results: Path, known: dict[str, dict]) -> None:
    """Give the kept file the time of the newest result."""
    os.utime(results / KEPT, ns=(_newest(known), _newest(known)))


def _newest(known: dict[str, dict]) -> int:
    return max(entry["time"] for entry in known.values())


def _digest(path: Path) -> str:
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
