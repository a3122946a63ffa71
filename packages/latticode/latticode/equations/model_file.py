"""Files of models: running them, reading their parameters, and locating their errors."""

import importlib
import sys
import traceback
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from .symbols import ModelError

SEED = "If it draws random numbers, seed them: numpy.random.default_rng(1)"

BEFORE = (
    "If it draws random numbers, draw them outside and pass them as a parameter: "
    'parameters = {"noise": numpy.random.default_rng(1).normal()}'
)


def run_file(path: Path, text: str) -> dict[str, Any]:
    """Execute a file and return its namespace.

    Modules in its folder are imported anew. Raises ModelError with the line that failed.
    """
    folder, namespace = path.resolve().parent, {"__file__": str(path), "__name__": path.stem}
    known, bytecode = _modules_in(folder), sys.dont_write_bytecode
    for name in known:
        del sys.modules[name]
    importlib.invalidate_caches()
    sys.path.insert(0, str(folder))
    sys.dont_write_bytecode = True
    try:
        exec(compile(text, str(path), "exec"), namespace)
    except (Exception, SystemExit) as error:
        raise ModelError(placed(error, str(path), text, path.name)) from None
    finally:
        sys.dont_write_bytecode = bytecode
        sys.path.remove(str(folder))
        for name in _modules_in(folder):
            del sys.modules[name]
        sys.modules.update(known)
    return namespace


def _modules_in(folder: Path) -> dict[str, Any]:
    """Return the loaded modules with files in a folder, except __main__."""
    files = {name: getattr(module, "__file__", None) for name, module in sys.modules.items()}
    inside = [name for name, file in files.items() if file and Path(file).parent == folder]
    return {name: sys.modules[name] for name in inside if name != "__main__"}


def placed(error: BaseException, place: str, text: str, name: str) -> str:
    """Return the message of an error with the failing line of the user's file or notebook."""
    frames = [
        frame for frame in traceback.extract_tb(error.__traceback__) if frame.filename == place
    ]
    at = frames[-1].lineno if frames else getattr(error, "lineno", None)
    reason = f"{error}" if isinstance(error, ModelError) else f"{type(error).__name__}: {error}"
    if at is None:
        return f"{name}: {reason}"
    in_file, lines = place.endswith(name), text.splitlines()
    line = lines[at - 1] if in_file and at <= len(lines) else frames[-1].line if frames else ""
    return f"{name}, line {at}: {reason}\n    {(line or '').strip()}"


def chain_sites(half_width: int | None, site_count: int | None = None) -> range:
    """Return the sites 0..site_count - 1 of a chain if a count is given, else -M..M."""
    return range(-half_width, half_width + 1) if site_count is None else range(site_count)


def values_at(value: Any, sites: range) -> float | list[float]:
    """Return a parameter as a number, or as a list with a number for each site of a chain.

    `value` is a number, a list or array (site,), or a function of the array of sites that returns
    one of these. Raises ValueError if the length differs or a number is not finite; callers put
    "parameter W" before the message.
    """
    if callable(value):
        value = call_on_sites(value, np.array(sites))
    values = _as_array(value)
    if values.shape not in ((), (len(sites),)):
        size = " x ".join(map(str, values.shape))
        hint = "; use a matrix only in couple(p.W, u)" if values.ndim == 2 else ""
        raise ValueError(f"has {size} values for {len(sites)} sites{hint}")
    wrong = np.flatnonzero(~np.isfinite(values))
    if wrong.size:
        where = f" at site {sites[wrong[0]]}" if values.ndim else ""
        raise ValueError(f"is {values.flat[wrong[0]]:g}{where}, which is not finite")
    return values.tolist()


def _as_array(value: Any) -> np.ndarray:
    """Return real numbers as an array; also converts text, because YAML reads 1e-5 as text."""
    kind = ""
    with suppress(TypeError, ValueError, OverflowError):
        values = np.asarray(value)
        kind = values.dtype.kind
        if kind in "iufU":
            return values.astype(float)
    text = "not a number or a list with one for each site"
    if kind == "c":
        text = "which is complex; give real and imaginary parts as two parameters"
    raise ValueError(f"is {_as_text(value)}, {text}")


def call_on_sites(function: Callable, sites: np.ndarray) -> Any:
    """Return function(sites); raises ValueError if a call fails or two calls differ."""
    with np.errstate(all="ignore"):
        try:
            first, second = function(sites.copy()), function(sites.copy())
        except Exception as error:
            text = f"is a function of the sites that fails: {type(error).__name__}: {error}"
            raise ValueError(text) from None
    if not same(first, second):
        raise ValueError(f"is a function of the sites with different values each time. {SEED}")
    return first


def same(a: Any, b: Any) -> bool:
    """Return whether two values, or arrays of them, are equal."""
    if hasattr(a, "tocoo") and hasattr(b, "tocoo"):
        return a.shape == b.shape and (a != b).nnz == 0
    try:
        return bool(np.array_equal(a, b, equal_nan=True))
    except TypeError:  # not numbers; these are rejected when the values are read
        return True


def _as_text(value: Any) -> str:
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else f"{text[:57]}..."
