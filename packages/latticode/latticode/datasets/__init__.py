"""Datasets on disk: reading and writing them, and what their variables are called."""

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from glob import escape
from pathlib import Path


class DatasetError(RuntimeError):
    """A file of results that cannot be written, or read back; the message names the file."""


@contextmanager
def complete_or_absent(path: str | Path) -> Iterator[Path]:
    """Yield a temporary path beside `path`, which is renamed to `path` if the block succeeds.

    So a file appears whole or not at all. Raises DatasetError where the disk is full or read-only,
    or something stands in the way.
    """
    path = Path(path)
    partial = path.with_name(f".{os.getpid()}.{path.name}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        _clear_after_killed(path)
        yield partial
        os.replace(partial, path)
    except OSError as error:
        if not _is_about(error, partial):
            raise
        raise not_written(path, error) from error
    finally:
        with suppress(OSError):  # where the folder is none, or read-only, there is nothing
            partial.unlink(missing_ok=True)


def _clear_after_killed(path: Path) -> None:
    """Remove what processes that were killed left of the file."""
    for left in path.parent.glob(f".*.{escape(path.name)}"):
        _, number, _ = left.name.split(".", 2)
        if number.isdigit():
            try:
                os.kill(int(number), 0)  # asks whether there is such a process, and does nothing
            except ProcessLookupError:
                left.unlink()
            except PermissionError:  # there is one, of another user
                continue


def _is_about(error: OSError, partial: Path) -> bool:
    """Return whether an error came from writing this file and not from reading another."""
    if error.filename is None:
        return error.errno is not None  # a full disk: a write knows no name
    return Path(error.filename) in (partial, *partial.parents)


def not_written(path: str | Path, error: Exception) -> DatasetError:
    """Return the error that says which file could not be written, why, and the way out."""
    path = Path(path)
    # one whole file may be written inside of another: the user knows the name of the outer one
    path = path.with_name(path.name.removeprefix(f".{os.getpid()}."))
    existing = next(folder for folder in path.absolute().parents if folder.exists())
    if not existing.is_dir():
        return DatasetError(f"could not write {path}: {existing} is a file and no folder; move it")
    if path.is_dir():
        return DatasetError(f"could not write {path}: it is a folder; move it")
    why = getattr(error, "strerror", None) or error
    if not os.access(existing, os.W_OK):
        return DatasetError(
            f"could not write {path}: {why}; make {existing} writable, and run again"
        )
    usage = shutil.disk_usage(existing)
    free, total = (f"{size / 1e6:.1f} MB" for size in (usage.free, usage.total))
    disk = next(place for place in (existing, *existing.parents) if os.path.ismount(place))
    return DatasetError(
        f"could not write {path}: {why} (is the disk full? {disk} has {free} of {total} left); "
        "make room there, and run again"
    )
