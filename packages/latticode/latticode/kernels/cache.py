"""The disk cache of compiled kernels, shared by all processes and projects of one user.

Compiling takes longer than most runs, so machine code is cached. The name of a file contains a hash
of everything that its content depends on: the text of the kernel's module and of its imports, the
versions and settings of the compiler, the processor, and the types of the arguments. Files are
written atomically and begin with a hash of their name and content, so that stale, incomplete or
exchanged files are never loaded.

The cache is in the platform's folder for caches (~/.cache/latticode on Linux). The environment
variable LATTICODE_CACHE sets another folder, or disables the cache (`off`). Loaded machine code is
executed, so the folder and its files must belong to this user and be writable by nobody else.
"""

import hashlib
import os
import platform
import tempfile
import time
import warnings
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

import platformdirs

from .sources import digest_of_modules

VARIABLE = "LATTICODE_CACHE"
OFF = "off"
UNUSED = 30 * 86400.0
"""After this time in seconds, unused code from earlier versions of a module is removed."""
DIGEST = hashlib.sha256().digest_size
DIGITS = 16
"""The number of hexadecimal digits of a hash in the name of a folder or file."""


def kept_in() -> Path | None:
    """Return the folder of the cache, or None if it is switched off or unsafe."""
    named = os.environ.get(VARIABLE, "").strip()
    if named.lower() == OFF:
        return None
    return _trusted(
        Path(named).expanduser() if named else platformdirs.user_cache_path("latticode")
    )


@cache
def _trusted(folder: Path) -> Path | None:
    """Return the folder, or None with a warning if other users could have written into it."""
    if _is_private(folder):
        return folder
    warnings.warn(
        f"compiled kernels in {folder} are not used, because another user owns that folder or can"
        f" write to it; kernels are kept in memory only. Set {VARIABLE} to a folder of your own, or"
        " withdraw the others' permission to write (chmod go-w)",
        stacklevel=4,
    )
    return None


def _is_private(place: Path | int) -> bool:
    """Return whether a folder or open file is absent, or writable by this user only."""
    try:
        status = os.stat(place)
    except OSError:  # absent or inaccessible; saving a kernel will report the latter
        return True
    return not hasattr(os, "geteuid") or (
        status.st_uid == os.geteuid() and not status.st_mode & 0o022
    )


def keep_source(name: str, text: str) -> Path:
    """Return the path of a generated module in a folder named by a hash of its text.

    The module is written only if there is a cache.
    """
    root = kept_in()
    file = (root or Path("generated")) / "sources" / _digest(text) / name
    if root and (not file.exists() or file.read_text(encoding="utf-8") != text):
        try:
            _write(file, text.encode())
        except OSError:  # saving the first kernel will fail too, and warn
            file = Path(tempfile.mkdtemp(prefix="latticode-")) / name
            file.write_text(text, encoding="utf-8")
    return file


def _write(file: Path, content: bytes) -> None:
    """Write a file atomically, with permissions for this user only."""
    # mkdir(parents=True) would apply `mode` to the last folder only
    absent = [folder for folder in file.parents if not folder.exists()]
    for folder in reversed(absent):
        folder.mkdir(mode=0o700, exist_ok=True)
    partial = file.with_suffix(f".{os.getpid()}-{time.monotonic_ns()}")
    try:
        partial.touch(mode=0o600, exist_ok=False)
        partial.write_bytes(content)
        partial.replace(file)
    finally:
        partial.unlink(missing_ok=True)


def folder_of(function: Callable, root: Path | None) -> Path | None:
    """Return the cache folder of a function's module; None without a cache.

    The folder's name contains a hash of the module's text, its imports and the compiler.
    """
    module = Path(function.__code__.co_filename).resolve()
    return root and root / f"{module.stem}-{_digest(digest_of_modules(module), _compiler())}"


class KernelFiles:
    """The cache files of one function, one for each combination of argument types."""

    def __init__(self, function: Callable, root: Path, ending: str) -> None:
        """Prepare the cache of `function`, which must not be a closure, below the folder `root`."""
        self._name, self._ending = function.__qualname__, ending
        self.folder = folder_of(function, root)

    def load(self, *key: Any) -> bytes | None:
        """Return the machine code saved under a `key` of argument types and processor.

        Returns None if there is none, or if the file is damaged or writable by others.
        """
        file = self._file(key)
        try:
            with file.open("rb") as stream:
                content = stream.read() if _is_private(stream.fileno()) else b""
            os.utime(self.folder)
        except OSError:
            return None
        payload = content[DIGEST:]
        return payload if content[:DIGEST] == self._seal(file, payload) else None

    @staticmethod
    def _seal(file: Path, payload: bytes) -> bytes:
        return hashlib.sha256(file.name.encode() + payload).digest()

    def save(self, payload: bytes, *key: Any) -> None:
        """Write machine code to the cache; if that fails, warn and continue."""
        file = self._file(key)
        try:
            if not self.folder.exists():
                self._remove_unused()
            _write(file, self._seal(file, payload) + payload)
        except OSError as fault:
            warnings.warn(
                f"compiled kernels cannot be saved in {self.folder.parent} ({fault.strerror}), so"
                f" each job compiles them again; set {VARIABLE} to another folder, or to `{OFF}`",
                stacklevel=2,
            )

    def _file(self, key: tuple) -> Path:
        return self.folder / f"{self._name}-{_digest(*key)}{self._ending}"

    def _remove_unused(self) -> None:
        """Remove machine code compiled from earlier versions of this module and unused for 30 days.

        The user's folder may contain other files, so only files named by this cache are removed.
        """
        former = self.folder.name.rpartition("-")[0]
        ours = f"{former}-{'[0-9a-f]' * DIGITS}"
        for folder in self.folder.parent.glob(ours):
            if time.time() - folder.stat().st_mtime > UNUSED:
                for ending in ("kernel", "part"):
                    for file in folder.glob(f"*.{ending}"):
                        file.unlink(missing_ok=True)
                with suppress(OSError):  # it contains other files
                    folder.rmdir()


def _digest(*texts: Any) -> str:
    return hashlib.sha256("\n".join(map(str, texts)).encode()).hexdigest()[:DIGITS]


def _compiler() -> list[str]:
    """Return the versions and settings of the compiler, on which machine code depends."""
    import llvmlite  # imported here: a workflow that calls only `kept_in` does not load numba
    import numba

    settings = sorted(f"{k}={v}" for k, v in os.environ.items() if k.startswith("NUMBA_"))
    return [platform.python_version(), numba.__version__, llvmlite.__version__, *settings]
