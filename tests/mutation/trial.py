"""Runs tests of a copy of the project in forks of this process, as plain Python or compiled.

Each mutant needs a new interpreter, and what most of its time goes into is the same for all: the
imports of libraries, so they are imported here once, and compilation, so most tests run without.
"""

import hashlib
import json
import os
import resource
import shutil
import signal
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from math import inf
from pathlib import Path
from typing import NoReturn

import hypothesis  # noqa: F401
import matplotlib.pyplot  # noqa: F401
import netCDF4  # noqa: F401
import numba
import pydantic  # noqa: F401
import pytest
import scipy.integrate
import scipy.linalg
import scipy.special  # noqa: F401
import xarray  # noqa: F401

ROOT = Path(__file__).resolve().parents[2]
COPIED = ("scripts", "tests", "config", "docs", "workflow", "benchmarks")
FILES = ("pyproject.toml", "environment.txt", "Snakefile")

SHORT = 1.5
"""Seconds of the processor that a test may take as plain Python."""
PATIENCE = 5.0, 10.0
"""A mutant is ended after so many times what the code itself takes, and so many seconds more."""

KILLED, ENDED, SURVIVED = "killed", "ended", "survived"


class Trial:
    """A copy of the project in which mutants of its library meet tests."""

    def __init__(self, folder: Path, compiled: bool = True):
        """Copy the project; without `compiled` tests that plain Python cannot run are left out.

        Kernels and times of tests that the folder holds from an earlier trial are used again.
        """
        self.compiled = compiled
        self.folder, self.kernels, self.log = folder, folder / "kernels", folder / "log"
        self.passed, self.times = folder / "passed.json", folder / "times.json"
        ignore = shutil.ignore_patterns("__pycache__")
        for name in COPIED:
            shutil.rmtree(folder / name, ignore_errors=True)
            shutil.copytree(ROOT / name, folder / name, ignore=ignore)
        for name in FILES:
            shutil.copy2(ROOT / name, folder)
        self.kernels.mkdir(parents=True, exist_ok=True)
        library = sorted((folder / "scripts/pendula").rglob("*.py"))
        self._library = "".join(path.read_text(encoding="utf-8") for path in library)
        self._known = json.loads(self.times.read_text()) if self.times.exists() else {}

    def digest(self, text: str, tests: Iterable[str]) -> str:
        """Return a hash of a text and of the tests that judge it, with what lies beside them."""
        files = {self.folder / test for test in tests}
        folders = {self.folder / "tests", *(file.parent for file in files)}
        files |= {path for folder in folders for path in folder.glob("*.py")
                  if not path.name.startswith("test_")}  # fmt: skip
        parts = [text, *(path.read_text(encoding="utf-8") for path in sorted(files))]
        return hashlib.sha256(json.dumps([self.compiled, *parts]).encode()).hexdigest()

    def text_of(self, module: str) -> str:
        """Return the text of a module of the library."""
        return self._path_of(module).read_text(encoding="utf-8")

    def _path_of(self, module: str) -> Path:
        return self.folder / "scripts/pendula" / module

    def outcome(self, module: str, text: str, tests: list[str]) -> str:
        """Return what becomes of a mutant: `text` in place of a module of the library.

        It meets first the tests that run as plain Python, and if it survives, the others.
        """
        for plain in (True, False) if self.compiled else (True,):
            chosen, seconds = self._unchanged(tests, plain)
            if chosen:
                with self._changed(module, text):
                    limit = PATIENCE[0] * seconds + PATIENCE[1]
                    outcome = self._run(chosen, limit, plain)[0]
                if outcome != SURVIVED:
                    return outcome
        return SURVIVED

    @contextmanager
    def _changed(self, module: str, text: str) -> Iterator[None]:
        """Put a text in place of a module for a while; leave no kernel of it behind.

        The module's old time stamp comes back too, since numba and Python would otherwise take
        what they keep of it for stale.
        """
        path, kept = self._path_of(module), self.folder / "unchanged"
        kernels = set(self.kernels.iterdir())
        shutil.copy2(path, kept)
        path.write_text(text, encoding="utf-8")
        try:
            yield
        finally:
            shutil.copy2(kept, path)
            for new in set(self.kernels.iterdir()) - kernels:
                shutil.rmtree(new)

    def _unchanged(self, tests: list[str], plain: bool) -> tuple[list[str], float]:
        """Return the tests that run as plain Python, or the others, and the seconds they take.

        It runs them once without a mutant. Raises RuntimeError where one fails.
        """
        digest, kind = self.digest(self._library, tests), "plain" if plain else "others"
        if digest not in self._known:
            self._known[digest] = self._times_as_plain_python(tests)
        chosen, seconds = self._known[digest][kind]
        if seconds is None:
            outcome, seconds = self._run(chosen, inf, False, writes=True)
            if outcome != SURVIVED:
                raise RuntimeError(f"tests fail without a mutant: {self.log.read_text()}")
            self._known[digest][kind] = chosen, seconds
        self.times.write_text(json.dumps(self._known))
        return chosen, seconds

    def _times_as_plain_python(self, tests: list[str]) -> dict[str, tuple]:
        """Return the tests that run as plain Python, quick ones first, and all others."""
        self._run(tests, inf, True, _Passed(self.passed), writes=True)
        passed = json.loads(self.passed.read_text())
        plain = sorted((test for test in passed if passed[test] < inf), key=passed.get)
        others = [test for test in passed if passed[test] == inf]
        return {
            "plain": (plain, sum(map(passed.get, plain))),
            "others": (others, None if others else 0.0),
        }

    def _run(self, tests, seconds, plain, *plugins, writes=False) -> tuple[str, float]:
        """Return the outcome of tests in a fork, and the time that the processor took.

        With `writes` it keeps the bytecode of all modules, which must not be that of a mutant.
        """
        child = os.fork()
        if child == 0:
            sys.dont_write_bytecode = not writes
            self._test(tests, seconds, plain, plugins)
        _, status, usage = os.wait4(child, 0)
        outcome = ENDED if os.WIFSIGNALED(status) else KILLED if status else SURVIVED
        return outcome, usage.ru_utime + usage.ru_stime

    def _test(self, tests, seconds, plain, plugins) -> NoReturn:
        """Run tests in this process, and leave it."""
        status = 1
        try:
            log = os.open(self.log, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
            os.dup2(log, 1)
            os.dup2(log, 2)
            if seconds < inf:
                resource.setrlimit(resource.RLIMIT_CPU, (int(seconds), int(seconds) + 5))
            os.chdir(self.folder)
            # 1 compiles in about the time of 0, whose kernels numba cannot keep
            os.environ |= {"NUMBA_DISABLE_JIT": str(int(plain)), "NUMBA_OPT": "1"}
            os.environ["PENDULA_CACHE"] = str(self.kernels)
            numba.config.reload_config()
            options = ["-q", "-o", "addopts=", "-p", "no:cacheprovider", "-p", "no:xdist"]
            options += ["--tb=no", "--assert=plain", *([] if plugins else ["-x"])]
            status = int(pytest.main([*options, "--rootdir", str(self.folder), *tests], plugins))
        finally:
            os._exit(status)


class _Passed:
    """Keeps how long each test takes, infinitely long if it fails or takes more than SHORT."""

    def __init__(self, path: Path):
        self.path, self.passed = path, {}

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_setup(self, item):
        return (yield from self._shortly())

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_call(self, item):
        return (yield from self._shortly())

    def _shortly(self):
        signal.signal(signal.SIGPROF, _give_up)
        signal.setitimer(signal.ITIMER_PROF, SHORT, SHORT)
        try:
            return (yield)
        finally:
            signal.setitimer(signal.ITIMER_PROF, 0.0)

    def pytest_runtest_logreport(self, report):
        seconds = report.duration if report.passed else inf
        self.passed[report.nodeid] = self.passed.get(report.nodeid, 0.0) + seconds

    def pytest_sessionfinish(self):
        self.path.write_text(json.dumps(self.passed))


class _TooLongError(BaseException):
    """No Exception, since hypothesis would look for a simpler example of one."""


def _give_up(number, frame):
    raise _TooLongError
