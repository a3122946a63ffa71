"""Where compiled kernels are kept between processes, projects and runs of one user.

Compiling takes longer than most runs, so machine code is kept. A file is named by all that its
content follows from: the text of the kernel's module and of all that it imports, the versions and
settings of the compiler, the processor, and the types of the arguments. It appears whole or not at
all, and it begins with a hash of its name and the rest. So it cannot be stale, torn, or that of
another kernel, wherever the project lies.

The folder is that of the platform for caches (~/.cache/latticode on Linux). The environment
variable LATTICODE_CACHE names another, or switches the cache off by `off`. Loading machine code
runs it, so only a folder and files that belong to this user, and that nobody else can write, are
used.
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

import platformdirs

from .sources import digest_of_modules

VARIABLE = "LATTICODE_CACHE"
OFF = "off"
UNUSED = 30 * 86400.0
"""Seconds after which machine code of a text that nobody runs any more is removed."""
DIGEST = hashlib.sha256().digest_size
DIGITS = 16
"""Hexadecimal digits of a digest in the name of a folder or a file."""


def kept_in() -> Path | None:
    """Return the folder of all kernels, or None where the user switched it off."""
    named = os.environ.get(VARIABLE, "").strip()
    if named.lower() == OFF:
        return None
    return _trusted(
        Path(named).expanduser() if named else platformdirs.user_cache_path("latticode")
    )


@cache
def _trusted(folder: Path) -> Path | None:
    """Return the folder, or None where others could have put code into it."""
    if _is_private(folder):
        return folder
    warnings.warn(
        f"compiled kernels in {folder} are not used, because other users own or can write that"
        f" folder; kernels are kept in memory only. Name a folder of your own by {VARIABLE}, or"
        " make this one yours alone (chmod go-w)",
        stacklevel=4,
    )
    return None


def _is_private(place: Path | int) -> bool:
    """Return whether only this user can have written a folder or an open file, or it is absent."""
    try:
        status = os.stat(place)
    except OSError:  # absent, or out of reach, which is reported when a kernel is to be kept
        return True
    return not hasattr(os, "geteuid") or (
        status.st_uid == os.geteuid() and not status.st_mode & 0o022
    )


def keep_source(name: str, text: str) -> Path:
    """Return the file of a generated module, whose text names its kernels; unwritten if none are
    kept."""
    root = kept_in()
    file = (root or Path("generated")) / "sources" / _digest(text) / name
    if root and (not file.exists() or file.read_text(encoding="utf-8") != text):
        try:
            _write(file, text.encode())
        except OSError:  # kernels cannot be kept either, and those who keep them say so
            file = Path(tempfile.mkdtemp(prefix="latticode-")) / name
            file.write_text(text, encoding="utf-8")
    return file


def _write(file: Path, content: bytes) -> None:
    """Write a file that appears whole or not at all, and that nobody else can write."""
    # `mode` of a mkdir with parents is that of the last folder alone, whatever the umask gives them
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
    """Return the folder below `root` for the module of a function, by its text and that of all that
    it imports; None if there is no root."""
    module = Path(function.__code__.co_filename).resolve()
    return root and root / f"{module.stem}-{_digest(digest_of_modules(module), _compiler())}"


class KernelFiles:
    """The files that keep the machine code of one function, each for some types of arguments."""

    def __init__(self, function: Callable, root: Path, ending: str):
        """Keep the machine code of `function`, which is no closure, below the folder `root`."""
        self._name, self._ending = function.__qualname__, ending
        self.folder = folder_of(function, root)

    def load(self, *key) -> bytes | None:
        """Return what was saved by the types of arguments and the processor that are the `key`.

        None if there is nothing, or what is there is damaged or written by others.
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

    def save(self, payload: bytes, *key) -> None:
        """Keep machine code. Where that is impossible the run goes on, with a warning."""
        file = self._file(key)
        try:
            if not self.folder.exists():
                self._remove_unused()
            _write(file, self._seal(file, payload) + payload)
        except OSError as fault:
            warnings.warn(
                f"compiled kernels cannot be kept in {self.folder.parent}, so that each job"
                f" compiles its own ({fault.strerror}); name another folder by {VARIABLE}, or"
                f" `{VARIABLE}={OFF}`",
                stacklevel=2,
            )

    def _file(self, key: tuple) -> Path:
        return self.folder / f"{self._name}-{_digest(*key)}{self._ending}"

    def _remove_unused(self) -> None:
        """Remove what was compiled from former texts of this module, unless it was used of late.

        A user may name a folder that holds other things too, so only what has the names of ours is
        removed.
        """
        former = self.folder.name.rpartition("-")[0]
        ours = f"{former}-{'[0-9a-f]' * DIGITS}"
        for folder in self.folder.parent.glob(ours):
            if time.time() - folder.stat().st_mtime > UNUSED:
                for ending in ("kernel", "part"):
                    for file in folder.glob(f"*.{ending}"):
                        file.unlink(missing_ok=True)
                with suppress(OSError):  # something else lies in it
                    folder.rmdir()


def _digest(*texts) -> str:
    return hashlib.sha256("\n".join(map(str, texts)).encode()).hexdigest()[:DIGITS]


def _compiler() -> list[str]:
    """Return the versions and the settings that machine code depends on."""
    import llvmlite  # here, since a workflow asks for the folder alone
    import numba

    settings = sorted(f"{k}={v}" for k, v in os.environ.items() if k.startswith("NUMBA_"))
    return [platform.python_version(), numba.__version__, llvmlite.__version__, *settings]
