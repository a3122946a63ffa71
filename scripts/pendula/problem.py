"""How windows and initial data are written in datasets; imports nothing, so that all may use it."""

import json


def name_window(window: tuple[float, float]) -> str:
    """Return a window as the datasets name it: "[10, 50]"."""
    return f"[{window[0]:g}, {window[1]:g}]"


def write_initial(initial: dict[int, tuple[complex, complex]]) -> str:
    """Return initial data as the configuration writes them: {"0": [1.0, 0.1]}."""
    return json.dumps({str(site): [_plain(z) for z in pair] for site, pair in initial.items()})


def _plain(z: complex) -> float | str:
    return z.real if z.imag == 0 else str(z).strip("()")
