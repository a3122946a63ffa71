"""The executor on a workflow of five rules: a fork is like a job that Snakemake starts alone."""

import json
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

if sys.platform != "linux":
    pytest.skip("only Linux forks safely; to have it run: run it on Linux", allow_module_level=True)

COMMAND = ("-m", "snakemake", "--cores", "2", "--rerun-incomplete", "--executor")
ROUNDABOUT = Path(sys.executable).parent / "../bin" / Path(sys.executable).name
MODULES = {
    "held": "FONT = open('../font', 'rb', buffering=0); FONT.seek(2)",
    "threaded": "import threading as t, time; t.Thread(target=time.sleep, args=[9]).start()",
}


@pytest.fixture
def folder(tmp_path):
    """Return a folder with the workflow, and beside it modules to import first."""
    (tmp_path / "font").write_text("12letters")
    for name, text in MODULES.items():
        (tmp_path / f"{name}.py").write_text(text)
    return shutil.copytree(Path(__file__).with_name("workflow"), tmp_path / "it's here")


def start(folder, *targets, modules="json", executor="forked", python=sys.executable):
    """Start a run in a group of processes of its own."""
    chosen = ["--forked-modules", modules] if executor == "forked" else []
    return subprocess.Popen(
        [python, *COMMAND, executor, *chosen, *map(str, targets)],
        cwd=folder,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
        env={**os.environ, "PYTHONPATH": str(folder.parent)},
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )


def hear(process, words, times=1):
    """Read what a run says until it has said these words so many times."""
    said = ""
    while said.count(words) < times:
        line = process.stdout.readline()
        assert line, said
        said += line


def end(process) -> str:
    """Return what a run says until all its processes have ended: each of them has this pipe."""
    return process.communicate()[0]


def run(folder, *targets, **options):
    """Return the exit status of a run and what it said."""
    process = start(folder, *targets, **options)
    said = end(process)
    return process.returncode, said


def test_a_fork_finds_what_snakemake_alone_gives_a_job(folder):
    assert run(folder, "a.json", executor="local", python=ROUNDABOUT)[0] == 0
    alone, forked, _ = json.loads((folder / "a.json").read_text())
    (folder / "a.json").unlink()
    targets, modules = ("a.json", "b.json", "--cores", 1), "held no_such_module json.*"
    status, said = run(folder, *targets, modules=modules, python=ROUNDABOUT)
    assert not forked and status == 0
    assert said.count("forked: ") == said.count("forked: cannot import no_such_module: ") == 1
    # the file that their parent holds open is at its old place for the second one too
    told, *others = json.loads((folder / "a.json").read_text())
    assert {name: told[name] for name in alone if told[name] != alone[name]} == {}
    assert others == [True, "lett"]
    assert json.loads((folder / "b.json").read_text())[1:] == [True, "lett"]


def test_a_benchmark_measures_the_job(folder):
    assert run(folder, "measured.txt")[0] == 0
    names, values = (line.split() for line in (folder / "measured.tsv").read_text().splitlines())
    measured = dict(zip(names, map(float, [values[0], 0, *values[2:]]), strict=True))
    assert measured["s"] >= 0.9 and measured["max_rss"] > 100 and measured["cpu_time"] > 0.2


@pytest.mark.parametrize(
    ("kind", "why", "edit"),
    [
        ("wide", "rule wide starts a Python of its own, since it has 2 threads", ""),
        ("json", "since what it imported runs 2 threads", ""),
        ("json", "since the workflow changes how commands are run", "shell.prefix('nice ')"),
        ("json", "since the workflow has changed MINE", "onstart: os.environ['MINE'] = ''"),
    ],
)
def test_a_fork_that_would_not_be_the_same_is_refused_and_told_once(folder, kind, why, edit):
    with open(folder / "Snakefile", "a") as file:
        file.write(f"\n{edit}\n")
    targets = [f"{n}.{kind}" for n in range(2)]
    status, said = run(folder, *targets, modules="threaded" if "runs" in why else "json")
    assert status == 0 and said.count("forked: ") == said.count(why) == 1
    assert not any(json.loads((folder / name).read_text())[1] for name in targets)


@pytest.mark.parametrize(
    ("how", "says"),
    [
        ("error", "ZeroDivisionError: division by zero"),
        ("exit", "enough"),
        ("kill", "forked: rule end failed: it was killed by signal 9 (SIGKILL): out of memory?"),
        ("server", "the process that jobs are forked from was killed by signal 9 (SIGKILL)"),
    ],
)
def test_a_job_that_fails_says_why_once_and_the_next_run_goes_on(folder, how, says):
    status, said = run(folder, f"{how}.end")
    assert status == 1 and said.count(says) == 1 and not (folder / f"{how}.end").exists()
    for noise in ("CalledProcessError", "server.py", "inside.py", sys.executable, "SystemExit"):
        assert noise not in said
    (folder / "mended").touch()
    assert run(folder, f"{how}.end")[0] == 0


@pytest.mark.parametrize(("kill", "times"), [(os.killpg, 1), (os.killpg, 3), (os.kill, 1)])
def test_ctrl_c_ends_all_without_a_traceback(folder, kill, times):
    process = start(folder, "1.wait", "2.wait")
    hear(process, "pid", 2)
    for _ in range(times):
        kill(process.pid, signal.SIGINT)
    said = end(process)
    assert process.returncode == 1 and said.count("interrupted: ") == 1
    assert "Traceback" not in said and "Error in rule" not in said


@pytest.mark.parametrize("jobs", [1, 3, 7, 12])
def test_ctrl_c_among_short_jobs_is_no_traceback(folder, jobs):
    process = start(folder, *(f"{n}.json" for n in range(30)))
    hear(process, "Finished jobid", jobs)
    os.killpg(process.pid, signal.SIGINT)
    said = end(process)
    assert process.returncode == 1 and "Traceback" not in said and "Error in rule" not in said


def test_ctrl_c_while_snakemake_reads_the_workflow_is_no_traceback(folder):
    with open(folder / "Snakefile", "a") as file:
        file.write("\nprint('reading', flush=True)\nimport time; time.sleep(99)\n")
    process = start(folder, "1.wait")
    hear(process, "reading")
    os.killpg(process.pid, signal.SIGINT)
    said = end(process)
    assert process.returncode == 130 and "interrupted: " in said and "Traceback" not in said


def test_no_job_outlives_snakemake(folder):
    process = start(folder, "1.wait")
    hear(process, "pid")
    process.kill()
    end(process)
