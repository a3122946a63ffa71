"""Where compiled kernels are kept between processes, projects and runs of one user.

Compiling takes longer than most runs, so machine code is kept. numba could keep it, but it names
what it keeps after the path and the time stamp of a source file: a moved or cloned project compiles
everything again, an edit of another file that the kernel calls goes unnoticed, and two processes
that compile one function for two types of arguments at once may write both to the same file. Here a
file is named by all that its content follows from: the text of the kernel's module and of all that
it imports, the versions and settings of the compiler, the processor, and the types of the
arguments. It appears whole or not at all, and it begins with a hash of its name and the rest. So it
cannot be stale, torn, or that of another kernel, wherever the project lies.

The folder is that of the platform for caches (~/.cache/pendula on Linux). The environment variable
PENDULA_CACHE names another, or switches the cache off by `off`. Loading machine code runs it, so
only a folder and files that belong to this user, and that nobody else can write, are used.
"""

import hashlib
import os
import pickle
import platform
import shutil
import tempfile
import time
import warnings
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path

try:
    import fcntl
except ImportError:  # Windows has none: two processes then compile what both need
    fcntl = None

import llvmlite
import numba
import platformdirs
from numba.core.caching import _Cache
from numba.core.compiler import CompileResult
from numba.core.serialize import dumps

from .sources import digest_of_modules

VARIABLE = "PENDULA_CACHE"
OFF = "off"
UNUSED = 30 * 86400.0
"""Seconds after which machine code of a text that nobody runs any more is removed."""
PATIENCE, LOOK = 120.0, 0.02
"""Seconds that a process waits for another that compiles what it needs, and between two looks."""
DIGEST = hashlib.sha256().digest_size
DIGITS = 16
"""Hexadecimal digits of a digest in the name of a folder or a file."""


def kept_in() -> Path | None:
    """Return the folder of all kernels, or None where the user switched it off."""
    named = os.environ.get(VARIABLE, "").strip()
    if named.lower() == OFF:
        return None
    return _trusted(Path(named).expanduser() if named else platformdirs.user_cache_path("pendula"))


@cache
def _trusted(folder: Path) -> Path | None:
    """Return the folder, or a temporary one where others could have put code into it."""
    if _is_private(folder):
        return folder
    other = Path(tempfile.gettempdir()) / f"pendula-{os.geteuid()}"
    other = other if _is_private(other) else None
    warnings.warn(
        f"compiled kernels in {folder} are not used, because other users own or can write that"
        f" folder; kernels are kept in {other or 'memory only'}. Name a folder of your own by"
        f" {VARIABLE}, or make this one yours alone (chmod go-w)",
        stacklevel=4,
    )
    return other


def _is_private(place: Path | int) -> bool:
    """Return whether only this user can have written a folder or an open file, or it is absent."""
    try:
        status = os.stat(place)
    except OSError:  # absent, or out of reach, which is reported when a kernel is to be kept
        return True
    return not hasattr(os, "geteuid") or (
        status.st_uid == os.geteuid() and not status.st_mode & 0o022
    )


class KernelCache(_Cache):
    """The machine code of one function, in the form that a dispatcher of numba asks for.

    What several processes need at once is compiled by one of them, and the others wait for it: a
    function that is not there is looked up under a lock, which its compiler holds until it is kept.
    """

    ENDING = ".kernel"

    def __init__(self, function: Callable, root: Path):
        """Keep the machine code of `function`, which is no closure, below the folder `root`."""
        module = Path(function.__code__.co_filename).resolve()
        self._name = function.__qualname__
        self._folder = root / f"{module.stem}-{_digest(digest_of_modules(module), _compiler())}"
        self._locks = {}

    @property
    def cache_path(self) -> str:
        """The folder of the machine code of this module."""
        return str(self._folder)

    def load_overload(self, signature, target_context) -> CompileResult | None:
        """Return the machine code for these types of arguments, or None where there is none."""
        target_context.refresh()
        file = self._file(signature, target_context.codegen())
        found = self._load(file, target_context)
        if found is None:
            self._lock(file)
            found = self._load(file, target_context)
        if found is not None:
            self.release()
        return found

    def _load(self, file: Path, target_context) -> CompileResult | None:
        """Return what a file keeps, or None: then the function is compiled, and kept again."""
        payload = self._read(file)
        try:
            return None if payload is None else self.restore(target_context, payload)
        except Exception:  # whatever unpickling raises: the payload is not one of this numba
            return None

    @staticmethod
    def restore(target_context, payload: bytes) -> CompileResult:
        """Return what `save_overload` kept."""
        return CompileResult._rebuild(target_context, *pickle.loads(payload))

    def _read(self, file: Path) -> bytes | None:
        """Return what is kept in a file; None if it is absent, damaged, or written by others."""
        try:
            with file.open("rb") as kept:
                content = kept.read() if _is_private(kept.fileno()) else b""
            os.utime(self._folder)
        except OSError:
            return None
        payload = content[DIGEST:]
        return payload if content[:DIGEST] == self._seal(file, payload) else None

    @staticmethod
    def _seal(file: Path, payload: bytes) -> bytes:
        return hashlib.sha256(file.name.encode() + payload).digest()

    def save_overload(self, signature, data: CompileResult) -> None:
        """Keep machine code. Where that is impossible the run goes on, with a warning.

        Code that holds addresses of this process, as of a large global array, is not kept.
        """
        if data.library.has_dynamic_globals:
            return
        payload = dumps(data._reduce())
        file = self._file(signature, data.codegen)
        try:
            self._make_folder()
            partial = file.with_suffix(f".{os.getpid()}-{time.monotonic_ns()}")
            try:
                with open(
                    partial, "xb", opener=lambda path, flags: os.open(path, flags, 0o600)
                ) as new:
                    new.write(self._seal(file, payload) + payload)
                partial.replace(file)
            finally:
                partial.unlink(missing_ok=True)
        except OSError as fault:
            warnings.warn(
                f"compiled kernels cannot be kept in {self._folder.parent}, so that each job"
                f" compiles its own ({fault.strerror}); name another folder by {VARIABLE}, or"
                f" `{VARIABLE}={OFF}`",
                stacklevel=2,
            )
        self.release()

    def _lock(self, file: Path) -> None:
        """Wait for another process that compiles the function of this file.

        The system unlocks what a killed process locked. Whoever waits for too long, or finds no
        locks in this folder, compiles too: that costs time, and both write the same.
        """
        if fcntl is None:
            return
        with suppress(OSError):
            self._make_folder()
            path = file.with_suffix(".lock")
            self._locks[path] = lock = os.open(path, os.O_CREAT | os.O_RDWR)
            give_up = time.monotonic() + PATIENCE
            while time.monotonic() < give_up:
                try:
                    return fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                except BlockingIOError:
                    time.sleep(LOOK)

    def release(self) -> None:
        """Let the processes go on that wait for this one, whether or not it compiled anything."""
        while self._locks:
            path, lock = self._locks.popitem()
            with suppress(OSError):
                path.unlink()
            os.close(lock)

    def enable(self) -> None:
        """Do nothing: a kernel whose code shall not be kept has no such cache."""

    disable = enable

    def flush(self) -> None:
        """Remove the machine code of this function's module."""
        shutil.rmtree(self._folder, ignore_errors=True)

    def _file(self, signature, codegen) -> Path:
        digest = _digest(signature, codegen.magic_tuple())
        return self._folder / f"{self._name}-{digest}{self.ENDING}"

    def _make_folder(self) -> None:
        if not self._folder.exists():
            self._remove_unused()
            self._folder.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
            self._folder.mkdir(mode=0o700, exist_ok=True)

    def _remove_unused(self) -> None:
        """Remove what was compiled from former texts of this module, unless it was used of late.

        A user may name a folder that holds other things too, so only what has the names of ours is
        removed.
        """
        former = self._folder.name.rpartition("-")[0]
        ours = f"{former}-{'[0-9a-f]' * DIGITS}"
        for folder in self._folder.parent.glob(ours):
            if time.time() - folder.stat().st_mtime > UNUSED:
                for ending in ("kernel", "part", "lock"):
                    for file in folder.glob(f"*.{ending}"):
                        file.unlink(missing_ok=True)
                with suppress(OSError):  # something else lies in it
                    folder.rmdir()


def _digest(*parts) -> str:
    return hashlib.sha256("\n".join(map(str, parts)).encode()).hexdigest()[:DIGITS]


def _compiler() -> list[str]:
    """Return the versions and the settings that machine code depends on."""
    settings = sorted(f"{k}={v}" for k, v in os.environ.items() if k.startswith("NUMBA_"))
    return [platform.python_version(), numba.__version__, llvmlite.__version__, *settings]
