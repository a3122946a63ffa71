"""Random models under every solver that takes them, against the same text run by NumPy and SciPy.

Most run their kernels as plain Python, every fifth is compiled. `.ci/elsewhere models` tries
hundreds.
"""

import os
import subprocess
import sys

import plain_kernels
import pytest
from judge_models import TURNS, judge
from random_models import drawn

MODELS = int(os.environ.get("LATTICODE_MODELS", 40))


def test_solvers_follow_random_models_in_plain_python(tmp_path):
    """In a process of its own, where the compiler is replaced before the library is imported."""
    run = subprocess.run(
        [sys.executable, plain_kernels.__file__, "0", str(MODELS)],
        env={**os.environ, "LATTICODE_CACHE": str(tmp_path)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.stdout == f"{MODELS} models are judged\n", run.stdout + run.stderr


@pytest.mark.parametrize("seed", range(0, MODELS, 5))
def test_compiled_solvers_follow_random_models(seed):
    """Under the default solver alone, but for long tests: each solver takes seconds to compile."""
    second = TURNS[seed % len(TURNS)] if MODELS > 40 else ()
    model = drawn(seed)
    assert not judge(model, ["taylor", *second]), str(model)
