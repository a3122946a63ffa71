"""A job logs in a sentence why it failed or ended, and how far it is."""

import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from helpers import python_path
from waiting import wait_for

JOB = """
import sys, threading
from types import SimpleNamespace
from pendula.contract.log import run
from latticode.datasets import DatasetError, complete_or_absent

def fail(result):
    with complete_or_absent(result) as partial:
        partial.write_text("half")
        {body}

run(lambda snakemake: fail("a.nc"), SimpleNamespace(log=[{log!r}]))
"""
WAIT = "print('waiting', flush=True); threading.Event().wait()"


def start(folder: Path, body: str, log: str = "a.log") -> subprocess.Popen:
    """Start a Python that runs a job with this body."""
    return subprocess.Popen(
        [sys.executable, "-c", JOB.format(body=body, log=log)],
        cwd=folder,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": python_path()},
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )


@pytest.mark.parametrize(
    ("body", "reason"),
    [
        ("raise DatasetError('a.nc is damaged: delete it')", "a.nc is damaged: delete it"),
        ("1 / 0", "ZeroDivisionError: division by zero"),
    ],
)
def test_an_error_is_a_sentence_in_the_log_above_its_traceback(tmp_path, body, reason):
    job = start(tmp_path, body)
    _, screen = job.communicate()
    assert job.returncode == 1 and screen == ""
    log = (tmp_path / "a.log").read_text()
    assert log.startswith(f"failed: {reason}\nTraceback")
    assert re.search(r"\nwall time: [\d.]+ s, largest memory: [1-9]\d+ MB\n$", log)
    assert [path.name for path in tmp_path.iterdir()] == ["a.log"]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupted_job_leaves_no_half_of_a_file(tmp_path, number):
    job = start(tmp_path, WAIT)
    wait_for(lambda: (tmp_path / "a.log").exists() and (tmp_path / "a.log").read_text())
    job.send_signal(number)
    _, screen = job.communicate()
    assert job.returncode == 130
    assert "interrupted: run the same command again" in screen and "Traceback" not in screen
    assert [path.name for path in tmp_path.iterdir()] == ["a.log"]


STEPS = """
import time
from types import SimpleNamespace
from replication import logs
logs.time = SimpleNamespace(monotonic=iter(range(0, 10**6, 60)).__next__)
progress = logs.Progress()
for done in range(1, 41):
    progress(done, 40)
"""


def test_a_job_of_many_runs_logs_how_many_are_done_and_the_time_that_is_left(tmp_path):
    """Between two of the twenty lines a minute passes here; the third is logged at 6 of 40 runs."""
    command = [sys.executable, "-c", STEPS]
    lines = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
    assert len(lines) == 20
    assert lines[2] == "6 of 40 runs done, about 17 min left"  # 34 runs at 3 min / 6 runs
    assert lines[-1] == "40 of 40 runs done"
