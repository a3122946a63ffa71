"""Progress of long work, and what Ctrl-C leaves of it."""

import os
import pty
import signal
import subprocess
import sys
import termios
import threading
import time

import numpy as np
import pytest
from latticode import Case, ConfigurationError, Model, abs2, lap, simulate, survey
from latticode.simulation import interrupts, progress
from latticode.simulation.interrupts import Interrupted

DNLS = Model(fields="u", parameters={"c": 1.0}, i_dt=lambda p, u: p.c * lap(u) + abs2(u) * u)
CASE = Case(model=DNLS, half_width=5, initial={0: [1.5]}, end_time=1)
LONG = CASE.changed(half_width=200, end_time=8000, output_step=5)  # over 0.1 s
SCRIPT = """
import signal
# shells let programs in the background ignore this signal
signal.signal(signal.SIGINT, signal.default_int_handler)
from latticode import Case, Model, abs2, lap, simulate
model = Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u) + abs2(u) * u)
print("begins", flush=True)
initial = {0: [1.5]}
simulate(Case(model=model, half_width=2000, initial=initial, end_time=60000, output_step=1))
"""


@pytest.fixture
def soon(monkeypatch):
    """Show bars at once, and as in a terminal."""
    monkeypatch.setattr(progress, "DELAY", 0.02)
    monkeypatch.setattr(progress, "LOOK", 0.01)
    monkeypatch.setattr(progress, "_threads", [])
    monkeypatch.setattr(progress, "is_visible", lambda: True)


def test_a_long_run_shows_how_far_it_is_and_the_time_left(soon, capsys):
    simulate(LONG)
    screen = capsys.readouterr().err
    assert "simulate: taylor:" in screen and "%" in screen and "<" in screen


def test_a_survey_shows_how_many_of_its_runs_are_done(soon, capsys):
    survey(LONG, {"c": [0.5, 0.6, 0.7, 0.8]}, keep=["final_l2"])
    assert "of 4 runs" in capsys.readouterr().err


def test_compiling_says_that_it_compiles(soon, capsys):
    number = time.time()  # no run before has compiled these equations
    model = Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u) + number * abs2(u) * u)
    simulate(CASE.changed(model=model, parameters={}, end_time=1e-6, output_step=1e-6))
    assert "simulate: compiling the equations" in capsys.readouterr().err


def test_nothing_is_shown_in_a_file(monkeypatch, capsys):
    monkeypatch.setattr(progress, "DELAY", 0.02)
    simulate(LONG)
    assert capsys.readouterr().err == ""


def test_what_is_shown_changes_no_bit(soon):
    run = simulate(LONG)
    progress.is_visible = lambda: False
    assert run.identical(simulate(LONG))


def test_ctrl_c_ends_a_script_in_one_line():
    """Its standard error is a terminal, so that a bar is shown too."""
    ours, theirs = pty.openpty()
    termios.tcsetwinsize(theirs, (24, 80))
    process = subprocess.Popen(
        [sys.executable, "-c", SCRIPT], stdout=subprocess.PIPE, stderr=theirs, text=True
    )
    os.close(theirs)
    screen = ""
    assert process.stdout.readline() == "begins\n"
    while "simulate: taylor:" not in screen:
        screen += os.read(ours, 1000).decode(errors="replace")
    process.send_signal(signal.SIGINT)
    process.wait(60)
    os.set_blocking(ours, False)
    try:
        while more := os.read(ours, 1000).decode(errors="replace"):
            screen += more
    except OSError:  # the end
        pass
    assert "Traceback" not in screen
    assert screen.rstrip().split("\r")[-1].strip() == "simulate was interrupted"


def test_jupyter_shows_an_interrupt_as_one_line():
    error = Interrupted("simulate was interrupted")
    assert error._render_traceback_() == ["simulate was interrupted"]
    assert isinstance(error, KeyboardInterrupt)


VALUES = [0.5, 0.6, 0.7, 0.8, 0.9, 1.0]


def interrupted_survey(after, cores=1):
    """Return what a survey returns that Ctrl-C interrupts in the run number `after`, and calls."""
    calls, ended = [], threading.Event()

    def peak(problem, run):
        calls.append(problem.parameters["c"])
        if len(calls) == after:
            signal.pthread_kill(threading.main_thread().ident, signal.SIGINT)
        if len(calls) >= after and not ended.is_set():
            wait_for_the_interrupt()
        return np.array([run.linf.max(), run.l2.max()])

    keep = [peak, "final_l2"]
    unfinished = survey(CASE, {"c": VALUES}, keep=keep, cores=cores)
    ended.set()
    return unfinished, keep, calls


def wait_for_the_interrupt():
    """Hold a run until the main thread is interrupted, which takes seconds on a busy machine."""
    start = time.monotonic()
    while not interrupts._main_thread_is_interrupted():
        assert time.monotonic() - start < 60
        time.sleep(0.01)
    time.sleep(0.5)  # the main thread must also set the flag that the other runs read


@pytest.fixture
def as_in_a_shell():
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.parametrize("cores", [1, 2])
def test_an_interrupted_survey_goes_on_from_the_runs_that_are_done(cores, as_in_a_shell, capsys):
    unfinished, keep, calls = interrupted_survey(3, cores)
    done = (unfinished["unfinished"] == "").values
    assert 0 < done.sum() < 6 and unfinished.attrs["unfinished_runs"] == 6 - done.sum()
    assert np.isnan(unfinished["final_l2"].values[~done]).all()
    assert f"{6 - done.sum()} of 6 runs are unfinished; to continue" in capsys.readouterr().out
    count = len(calls)
    resumed = survey(CASE, {"c": VALUES}, keep=keep, resume=unfinished)
    assert sorted(calls[count:]) == [c for c, was in zip(VALUES, done, strict=True) if not was]
    assert resumed.identical(survey(CASE, {"c": VALUES}, keep=keep))


def test_an_interrupt_before_the_first_run_is_done_ends_a_survey(as_in_a_shell):
    main = threading.main_thread().ident
    threading.Timer(0.5, lambda: signal.pthread_kill(main, signal.SIGINT)).start()
    endless = LONG.changed(end_time=1e5, output_step=1)
    with pytest.raises(Interrupted, match="survey was interrupted"):
        survey(endless, {"c": VALUES})


def test_another_survey_is_not_resumed(as_in_a_shell):
    unfinished, keep, _ = interrupted_survey(3)
    for call in (
        lambda: survey(CASE, {"c": VALUES[:3]}, keep=keep, resume=unfinished),
        lambda: survey(CASE.changed(end_time=2), {"c": VALUES}, keep=keep, resume=unfinished),
        lambda: survey(CASE, {"c": VALUES}, keep=["max_l2"], resume=unfinished),
    ):
        with pytest.raises(ConfigurationError, match=r"differs in (c|end_time)|no max_l2"):
            call()
