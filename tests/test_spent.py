"""What processor time is spent on adds up, and each kind is told from the others."""

import os
import time

import numba
import numpy as np
from helpers import skip
from pendula import spent
from pendula.compiled import copy
from pendula.datasets.netcdf import Variable, write
from pendula.drawing import style


def work(seconds=0.02):
    start = time.process_time()
    while time.process_time() < start + seconds:
        pass


def grown(act) -> dict[str, float]:
    before = spent.seconds()
    act()
    return {kind: after - before[kind] for kind, after in spent.seconds().items()}


@style.styled
def draw_and_write(path):
    work()
    write(path, {"a": Variable((), 1.0, "a")}, {"title": "a"})


def test_kinds_add_up_to_the_time_of_the_process():
    start = time.process_time()
    spent.seconds()
    kinds = grown(work)
    assert kinds[spent.REST] >= 0.02
    assert sum(kinds.values()) <= time.process_time() - start


def test_compiling_and_loading_of_kernels_are_told():
    assert grown(lambda: numba.njit(lambda x: x + 1.0)(1.0))["compiling"] > 0.0
    one = np.ones((1, 1), np.float32)  # which nobody else copies
    assert grown(lambda: copy(one, one))["compiling"] > 0.0


def test_writing_in_a_drawing_is_writing(tmp_path):
    kinds = grown(lambda: draw_and_write(tmp_path / "a.nc"))
    assert kinds["drawing"] >= 0.02 and kinds["writing"] > 0.0


def test_a_fork_counts_from_zero():
    if not hasattr(os, "fork"):
        skip("this system has no forks", "run it on Linux")
    work()
    child = os.fork()
    if child == 0:
        os._exit(sum(spent.seconds().values()) < 0.01)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 1
