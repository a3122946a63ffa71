"""Ctrl-C ends a compiled run: every kernel reads the flag, and whoever waits for it raises it."""

import os
import signal
import socket
import subprocess
import sys
import threading
import weakref
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import latticode
import numpy as np
import pytest
from dimers import SOLVERS, chain
from latticode.integrators import INTERRUPTED
from latticode.localised import tangents
from latticode.simulation import simulate as simulation
from latticode.simulation.interrupts import interruptible
from latticode.simulation.lattice import FULL_CHAIN, pack
from latticode.simulation.simulate import IntegrationError, simulate
from oracle import random_chain
from waiting import HANGS, wait_for

# --- The flag in the kernels ----------------------------------------------------------------------


def with_flag_up(run, *arguments):
    """Stand in for `interruptible`: the flag is up from the start."""
    return run(*arguments, np.ones(1, np.bool_))


def tangent(problem):
    return tangents.grow(problem, np.ones((1, *problem.amplitudes.shape), complex), 1.0)


@pytest.mark.parametrize("name", [*SOLVERS, "tangents"])
def test_a_run_ends_where_the_flag_is_up(name, monkeypatch):
    module, run = (tangents, tangent) if name == "tangents" else (simulation, simulate)
    problem = chain(random_chain(3), solver=SOLVERS.get(name, SOLVERS["dop853"]))
    run(problem)
    monkeypatch.setattr(module, "interruptible", with_flag_up)
    with pytest.raises(IntegrationError, match="it was interrupted"):
        run(problem)


# --- From Ctrl-C to the flag ----------------------------------------------------------------------


@pytest.fixture
def ctrl_c():
    """Return what acts as Ctrl-C, also where a shell started the tests to ignore it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield lambda: signal.pthread_kill(threading.main_thread().ident, signal.SIGINT)
    signal.signal(signal.SIGINT, before)


class LongRun:
    """A run of hours on a chain so stiff that no solver can take long steps."""

    times = np.array([0.0, 1e-4, 2e-4, 3e3])

    def __init__(self, name):
        problem = chain(random_chain(2000), (1e4, 1.0, 0.0))
        equations = problem.equations
        self.compiled, self.outcomes = equations.compiled(name), []
        self.controls = SOLVERS[name] | {"rtol": 1e-4, "atol": 1e-4, "step": 1e-5}
        self.state = pack(problem.amplitudes, FULL_CHAIN)
        self.record = equations.record(2, problem.sites, self.times.size, 0, conserved=False)
        self.record.l2[:] = np.nan
        self.system = equations.system(FULL_CHAIN)
        self.kernel = self.call  # one object, so that a second run finds the first
        self.thread = None

    def start(self, outputs=4):
        """Begin the run up to some of its outputs and wait for it."""
        controls = self.compiled.controls_of(self.controls)
        work = self.compiled.work_for(self.system, self.state)
        return interruptible(
            self.kernel, self.system, self.state, self.times[:outputs], controls, work, self.record
        )

    def call(self, *arguments):
        self.thread = threading.get_ident()
        self.outcomes.append(self.compiled.run(*arguments))
        return self.outcomes[-1]

    def is_under_way(self) -> bool:
        """Return whether the kernel has come to the output before the last."""
        return bool(np.isfinite(self.record.l2[0, -2]))


def press_when(happened, ctrl_c) -> None:
    """Press Ctrl-C once, as soon as `happened()`."""

    def watch():
        wait_for(happened)
        ctrl_c()

    threading.Thread(target=watch, daemon=True).start()


@pytest.mark.parametrize("name", SOLVERS)
def test_ctrl_c_ends_a_run_that_would_take_hours(name, ctrl_c):
    run = LongRun(name)
    press_when(run.is_under_way, ctrl_c)
    with pytest.raises(KeyboardInterrupt):
        run.start()
    wait_for(lambda: run.outcomes)
    assert run.outcomes[0].status == INTERRUPTED and run.outcomes[0].steps > 0


@pytest.mark.parametrize("name", SOLVERS)
def test_ctrl_c_ends_a_run_of_the_main_thread(name, ctrl_c):
    run = LongRun(name)
    run.start(outputs=2)
    press_when(run.is_under_way, ctrl_c)
    with pytest.raises(KeyboardInterrupt):
        run.start()
    assert run.thread == threading.get_ident() and run.outcomes[1].status == INTERRUPTED


def test_ctrl_c_ends_all_runs_of_a_pool_of_threads(ctrl_c):
    runs = [LongRun("taylor"), LongRun("dop853")]
    press_when(lambda: all(run.is_under_way() for run in runs), ctrl_c)
    with pytest.raises(KeyboardInterrupt), ThreadPoolExecutor(len(runs)) as pool:
        list(pool.map(LongRun.start, runs))
    wait_for(lambda: all(run.outcomes for run in runs))  # a step may take longer than callers wait
    assert [run.outcomes[0].status for run in runs] == [INTERRUPTED] * len(runs)


@pytest.fixture
def known():
    """Return a run that was done before: it calls a function, and says in which thread."""

    def run(call, stop):
        call()
        return threading.get_ident(), bool(stop[0])

    interruptible(run, lambda: None)
    return run


def test_an_interrupt_ends_one_run_and_not_the_next(known, ctrl_c):
    for _ in range(100):  # the thread that reads signals must not come late
        with pytest.raises(KeyboardInterrupt):
            interruptible(known, ctrl_c)
        assert interruptible(known, lambda: None) == (threading.get_ident(), False)


def test_a_handler_of_ones_own_hears_the_interrupt(known, ctrl_c):
    heard = []
    signal.signal(signal.SIGINT, lambda number, frame: heard.append(number))
    thread, flag = interruptible(known, ctrl_c)
    assert thread != threading.get_ident() and not flag and heard == [signal.SIGINT]


def test_a_descriptor_for_signals_stays_with_who_set_it(known, ctrl_c):
    reads, writes = socket.socketpair()
    writes.setblocking(False)
    with reads, writes:
        signal.set_wakeup_fd(writes.fileno())
        thread, _ = interruptible(known, lambda: None)
        assert signal.set_wakeup_fd(-1) == writes.fileno() and thread != threading.get_ident()
    interruptible(known, lambda: None)
    assert signal.set_wakeup_fd(-1) == -1


def test_a_fault_of_the_run_reaches_the_caller(known, ctrl_c):
    def fail():
        raise MemoryError("too large")

    for run in (lambda call, stop: call(), known):
        with pytest.raises(MemoryError, match="too large"):
            interruptible(run, fail)
        assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_a_thread_does_one_run_after_another_and_keeps_no_array():
    first = interruptible(lambda stop: threading.get_ident())
    array = np.zeros(3)
    reference = weakref.ref(array)
    assert interruptible(lambda values, stop: threading.get_ident(), array) == first
    del array
    wait_for(lambda: reference() is None)
    assert first != threading.get_ident()


def test_a_fork_has_threads_of_its_own(known, ctrl_c):
    assert interruptible(known, lambda: None) == (threading.get_ident(), False)
    child = os.fork()
    if not child:
        signal.alarm(HANGS)  # ends the child, whoever waits in it
        with pytest.raises(KeyboardInterrupt):
            interruptible(known, ctrl_c)
        os._exit(interruptible(lambda stop: 5))
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 5


CRASH = """
import os, signal, sys, threading
from typing import NamedTuple
import numba

class Outcome(NamedTuple):
    value: float

@numba.njit(nogil=True)
def run(flag, total):
    total[0] = 0.0
    while flag[0] == 0:  # read again every time: for LLVM, the other array may be the same
        total[0] += 1.0
    return Outcome(total[0])

import numpy as np
from latticode.simulation.interrupts import interruptible
flag, total = np.zeros(1), np.zeros(1)
run(np.ones(1), total)
signal.signal(signal.SIGINT, signal.default_int_handler)

def press():
    os.kill(os.getpid(), signal.SIGINT)
    flag[0] = 1.0

def wait_for_flag(stop):
    return run(flag, total)

if DONE_BEFORE:
    flag[0] = 1.0
    interruptible(wait_for_flag)
    flag[0] = 0.0
threading.Timer(0.1, press).start()
interruptible(wait_for_flag)
"""


@pytest.mark.parametrize("done_before", [False, True])
def test_ctrl_c_in_a_kernel_that_returns_a_named_tuple(done_before):
    """It kills Python if called as it is: numba makes the tuple by a call of Python, which hears an
    interrupt, and does not look whether the call worked. In a thread of its own, or in the main
    thread while an interrupt raises nothing but the flag, a kernel returns in peace.
    """
    env = {**os.environ, "PYTHONPATH": str(Path(latticode.__file__).parents[1])}
    code = f"DONE_BEFORE = {done_before}\n{CRASH}"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=env)
    assert done.returncode == -signal.SIGINT, done.stderr
