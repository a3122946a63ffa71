"""A job says in a sentence why it failed or ended, and its log has the rest."""

import math
import os
import re
import signal
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import dataset
import job
import pytest
from helpers import python_path
from latticode.datasets.netcdf import Variable, read, write
from waiting import wait_for

JOB = """
import sys, threading
from types import SimpleNamespace
from latticode.datasets import DatasetError, complete_or_absent
from job import run

def fail(result):
    with complete_or_absent(result) as partial:
        partial.write_text("half")
        {body}

run(lambda snakemake: fail("a.nc"), SimpleNamespace(log=[{log!r}]))
"""
WAIT = "print('waiting', flush=True); threading.Event().wait()"


def start(folder: Path, body: str, log: str = "a.log") -> subprocess.Popen:
    return subprocess.Popen(
        [sys.executable, "-c", JOB.format(body=body, log=log)],
        cwd=folder,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": python_path()},
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )


@pytest.mark.parametrize(
    ("body", "says"),
    [
        ("raise DatasetError('a.nc is damaged: delete it')", "a.nc is damaged: delete it"),
        ("1 / 0", "ZeroDivisionError: division by zero"),
    ],
)
def test_a_fault_is_a_sentence_in_the_log_above_its_traceback(tmp_path, body, says):
    job = start(tmp_path, body)
    _, screen = job.communicate()
    assert job.returncode == 1 and screen == ""
    log = (tmp_path / "a.log").read_text()
    assert log.startswith(f"failed: {says}\nTraceback")
    assert re.search(r"\nwall time: [\d.]+ s, largest memory: [1-9]\d+ MB\n$", log)
    assert [path.name for path in tmp_path.iterdir()] == ["a.log"]


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupted_job_leaves_no_half_of_a_file(tmp_path, how):
    job = start(tmp_path, WAIT)
    wait_for(lambda: (tmp_path / "a.log").exists() and (tmp_path / "a.log").read_text())
    job.send_signal(how)
    _, screen = job.communicate()
    assert job.returncode == 130
    assert "interrupted: run the same command again" in screen and "Traceback" not in screen
    assert [path.name for path in tmp_path.iterdir()] == ["a.log"]


class Named(dict):
    """Names with values, as Snakemake hands them to a script."""

    __getattr__ = dict.__getitem__


def test_a_job_gets_inputs_settings_and_files_of_the_project_by_name(monkeypatch):
    monkeypatch.setattr(job, "SCRIPTS", Path("/project/scripts"))
    params = Named(
        call=["math.sqrt", "0f"], code="1f", seed=7, given={"members": 3},
        committed={"one": ["kept/a.nc", "2f"], "many": [["b.nc", "3f"], ["c.nc", "4f"]]},
    )  # fmt: skip
    snakemake = SimpleNamespace(input=Named(run="r.nc", kernels=["k"], ensembles=[]), params=params)
    assert job.arguments(snakemake) == {
        "run": "r.nc", "seed": 7, "members": 3, "one": "/project/kept/a.nc",
        "many": ["/project/b.nc", "/project/c.nc"],
    }  # fmt: skip
    assert job.called(snakemake) == [math.sqrt]


def test_each_dataset_of_a_job_states_its_own_entry_and_names_what_it_was_made_from(tmp_path):
    source, made = tmp_path / "checks" / "source.nc", [tmp_path / f"wrong/{n}.nc" for n in "ab"]
    write(source, {"mine": Variable((), 1.0, "mine")}, {"title": "A source"})
    snakemake = SimpleNamespace(
        input={"source": str(source)},
        params=Named(
            call=[f"{__name__}.{make.__name__}", "hash of the code"],
            checks={"wrong/a": {"seed": 1}, "wrong/b": {"seed": 2}},
            members=4,
        ),
        output=list(map(str, made)),
    )
    dataset.make(snakemake)
    for seed, path in enumerate(made, 1):
        about = read(path).attrs
        assert (about["seed"], about["members"], about["sites"]) == (seed, 4, 9)
        assert "checks" not in about and about["computed_from"].endswith("checks/source")


def make(source, checks, members):
    for _ in checks:
        yield {"mine": Variable((), float(source["mine"]), "mine")}, {"title": "Two", "sites": 9}
