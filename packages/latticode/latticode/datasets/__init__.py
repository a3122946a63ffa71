"""Datasets on disk: reading and writing them, and the names of their variables."""

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from glob import escape
from pathlib import Path


class DatasetError(RuntimeError):
    """A file of results cannot be written or read; the message names the file."""


@contextmanager
def complete_or_absent(path: str | Path) -> Iterator[Path]:
    """Yield a temporary path in the same folder; rename it to `path` if the block succeeds.

    So `path` is never incomplete. Raises DatasetError if the disk is full or read-only, if `path`
    is a folder, or if one of its folders is a file.
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
        with suppress(OSError):  # in a missing or read-only folder nothing was written
            partial.unlink(missing_ok=True)


def _clear_after_killed(path: Path) -> None:
    """Remove the temporary files of `path` that killed processes have left."""
    for left in path.parent.glob(f".*.{escape(path.name)}"):
        _, number, _ = left.name.split(".", 2)
        if number.isdigit():
            try:
                os.kill(int(number), 0)  # signal 0 only checks that the process exists
            except ProcessLookupError:
                left.unlink()
            except PermissionError:  # the process exists, and belongs to another user
                continue


def _is_about(error: OSError, partial: Path) -> bool:
    """Return whether an error is from writing this file, not from reading another one."""
    if error.filename is None:
        return error.errno is not None  # such as a full disk: errors of `write` have no file name
    return Path(error.filename) in (partial, *partial.parents)


def not_written(path: str | Path, error: Exception) -> DatasetError:
    """Return the error for a file that could not be written, with the reason and the remedy."""
    path = Path(path)
    # `complete_or_absent` may be nested; the message has the name without the temporary prefix
    path = path.with_name(path.name.removeprefix(f".{os.getpid()}."))
    existing = next(folder for folder in path.absolute().parents if folder.exists())
    if not existing.is_dir():
        return DatasetError(f"could not write {path}: {existing} is a file, not a folder; move it")
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
