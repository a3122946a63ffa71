"""The executor on a workflow of five rules: a fork is like a job that Snakemake starts alone."""

import json
import os
import select
import shutil
import signal
import socket
import sys
import time
from pathlib import Path

import pytest
from snakemake_executor_plugin_forked.forks import MAX_MESSAGE_BYTES, Parent
from starting import Run

if sys.platform != "linux":
    pytest.skip("only Linux forks safely; to have it run: run it on Linux", allow_module_level=True)

ROUNDABOUT = Path(sys.executable).parent / "../bin" / Path(sys.executable).name
OPTIONS = ("--cores", "2", "--rerun-incomplete", "--executor")
THREADED = "import threading as t, time; t.Thread(target=time.sleep, args=[9]).start()"


@pytest.fixture
def folder(tmp_path):
    """Return a folder with the workflow, and beside it modules to import first."""
    (tmp_path / "font").write_text("12letters")
    (tmp_path / "held.py").write_text("FONT = open('../font', 'rb', buffering=0); FONT.seek(2)")
    (tmp_path / "threaded.py").write_text(THREADED)
    return shutil.copytree(Path(__file__).with_name("workflow"), tmp_path / "it's here")


def run(folder, *targets, modules="json", executor="forked", meanwhile=None, path=True):
    """Return the exit status of a run and what it output; `meanwhile` is done with its process.

    Each of its processes has the pipe that is read here to the end: none is left when this returns.
    """
    chosen = ["--forked-modules", modules] if executor == "forked" else []
    variables = {**os.environ, **({"PYTHONPATH": str(folder.parent)} if path else {})}
    process = Run(ROUNDABOUT, folder, [*OPTIONS, executor, *chosen, *targets], variables)
    if meanwhile:
        meanwhile(process)
    return process.end()


def hear(process, words, times=1):
    """Read what a run says until it has output these words so many times."""
    output = ""
    while output.count(words) < times:
        output += (line := process.stdout.readline())
        assert line, f"it has ended: {output}"


SETS = "import os; os.environ['PYTHONPATH'] = os.path.abspath('..')\n"


@pytest.mark.parametrize(
    ("sets", "modules"),
    [
        ("", "held no_such_module json.*"),
        # there is another colorsys below
        (f"{SETS}os.environ['NEW'] = ''", "colorsys held no_such_module json.*"),
    ],
)
def test_a_fork_finds_what_snakemake_alone_gives_a_job(folder, sets, modules):
    """Whether the workflow sets where modules are and more, or puts one in another's place."""
    (folder.parent / "colorsys.py").write_text("import held")
    with open(folder / "Snakefile", "a") as file:
        file.write(f"\n{sets}\n")
    path = not sets
    assert run(folder, "a.json", executor="local", path=path)[0] == 0
    alone, forked, _ = json.loads((folder / "a.json").read_text())
    (folder / "a.json").unlink()
    targets = ("a.json", "b.json", "--cores", "1")
    status, output = run(folder, *targets, modules=modules, path=path)
    assert not forked and status == 0
    assert output.count("forked: ") == output.count("forked: cannot import no_such_module: ") == 1
    # the file that their parent holds open is at its old place for the second one too
    reports, *checks = json.loads((folder / "a.json").read_text())
    assert {name: reports[name] for name in alone if reports[name] != alone[name]} == {}
    assert checks == json.loads((folder / "b.json").read_text())[1:] == [True, "lett"]


def test_a_benchmark_measures_the_job(folder):
    assert run(folder, "measured.txt")[0] == 0
    names, values = (line.split() for line in (folder / "measured.tsv").read_text().splitlines())
    measured = dict(zip(names, map(float, [values[0], 0, *values[2:]]), strict=True))
    assert measured["s"] >= 0.9 and measured["max_rss"] > 100 and measured["cpu_time"] > 0.2


@pytest.mark.parametrize(
    ("kind", "modules", "edit", "why"),
    [
        (
            "wide",
            "json",
            "",
            "rule wide runs in a separate Python process because it has 2 threads",
        ),
        ("json", "threaded", "", "because the imported modules run 2 threads"),
        ("json", "json", "shell.prefix('nice ')", "the workflow changes how shell"),
    ],
)
def test_a_job_that_cannot_be_a_fork_says_so_once(folder, kind, modules, edit, why):
    with open(folder / "Snakefile", "a") as file:
        file.write(f"\n{edit}\n")
    targets = [f"{n}.{kind}" for n in range(2)]
    status, output = run(folder, *targets, modules=modules)
    assert status == 0 and output.count("forked: ") == output.count(why) == 1
    assert not any(json.loads((folder / name).read_text())[1] for name in targets)


DIES_FIRST = """
import os
try:
    os.mkdir("../died")
    os.kill(os.getpid(), 9)
except FileExistsError:
    pass
"""
DIES = "import os; os.kill(os.getpid(), 9)"
KILLED = "the process that jobs are forked from was killed by signal 9 (SIGKILL)"


@pytest.mark.parametrize(("module", "forked", "reports"), [(DIES_FIRST, True, 0), (DIES, False, 1)])
def test_a_parent_that_dies_is_started_again_and_given_up_if_it_dies_again(
    folder, module, forked, reports
):
    (folder.parent / "fatal.py").write_text(module)
    targets = [f"{n}.json" for n in range(4)]
    status, output = run(folder, *targets, modules="fatal")
    assert status == 0 and output.count("forked: ") == output.count(KILLED) == reports
    assert [json.loads((folder / name).read_text())[1] for name in targets] == [forked] * 4


def test_jobs_after_one_that_killed_their_parent_are_forks(folder):
    status, output = run(folder, "--keep-going", "--cores", "1", "server.end", "a.json", "b.json")
    assert status == 1 and output.count("forked: ") == output.count(KILLED) == 1
    assert [json.loads((folder / f"{n}.json").read_text())[1] for n in "ab"] == [True, True]


def test_an_import_that_ends_python_is_told_and_ends_nothing(folder):
    (folder.parent / "leaves.py").write_text("import sys; sys.exit('not meant to be imported')")
    status, output = run(folder, "a.json", modules="leaves json")
    reports = "forked: cannot import leaves: SystemExit('not meant to be imported')"
    assert status == 0 and output.count("forked: ") == output.count(reports) == 1
    assert json.loads((folder / "a.json").read_text())[1]


@pytest.mark.parametrize(("option", "imports"), [("-np", 0), ("--dryrun", 0), ("-Rend", 1)])
def test_a_dry_run_starts_no_process_and_what_only_looks_like_one_does(folder, option, imports):
    (folder.parent / "marks.py").write_text("open('../marked', 'a').close()")
    status, _ = run(folder, "a.json", option, modules="marks")
    assert status == 0
    assert [(folder / "a.json").exists(), (folder.parent / "marked").exists()] == [imports] * 2


FAILS = {
    "error": "ZeroDivisionError: division by zero",
    "exit": "enough",
    "kill": "forked: rule end failed: it was killed by signal 9 (SIGKILL): out of memory?",
}
SERVER_FAILS = {"server": KILLED}


def test_jobs_that_fail_say_why_once_and_the_next_run_goes_on(folder):
    for fails in (FAILS, SERVER_FAILS):
        status, output = run(folder, "--keep-going", *(f"{how}.end" for how in fails))
        assert status == 1 and [output.count(text) for text in fails.values()] == [1] * len(fails)
        for noise in ("CalledProcessError", "server.py", "inside.py", sys.executable, "SystemExit"):
            assert noise not in output
    assert not list(folder.glob("*.end"))
    (folder / "mended").touch()
    assert run(folder, *(f"{how}.end" for how in FAILS | SERVER_FAILS))[0] == 0


@pytest.mark.parametrize(
    ("targets", "words", "heard", "pressed", "status"),
    [
        ([f"{n}.json" for n in range(30)], "Finished jobid", 7, 1, 1),
        (["1.wait", "2.wait"], "pid", 2, 3, 1),
        (["1.wait", "--config", "slow=1"], "reading", 1, 1, 130),
    ],
)
def test_ctrl_c_ends_all_without_a_traceback(folder, targets, words, heard, pressed, status):
    def interrupt(process):
        hear(process, words, heard)
        for _ in range(pressed):
            os.killpg(process.pid, signal.SIGINT)

    ended, output = run(folder, *targets, meanwhile=interrupt)
    assert ended == status and "Traceback" not in output and "Error in rule" not in output


def test_no_job_outlives_snakemake_that_was_killed_and_the_last_line_says_how_to_go_on(folder):
    _, output = run(folder, "1.wait", meanwhile=lambda run: hear(run, "pid") or run.kill())
    assert output.splitlines()[-1].startswith("forked: Snakemake was killed")
    assert "snakemake --unlock" in output and "Traceback" not in output


def test_a_job_ends_without_a_word_if_snakemake_is_killed_as_it_begins(tmp_path, capfd):
    """Then the system resets the connection, since the number of the job was not read."""
    (tmp_path / "job.py").write_text("print('begun')")
    (parent := Parent([])).send_path("")
    answer = parent.send_request({"script": str(tmp_path / "job.py"), "environment": {}})
    select.select([answer], [], [])
    job = int(answer.recv(MAX_MESSAGE_BYTES, socket.MSG_PEEK))
    answer.close()
    while os.path.exists(f"/proc/{job}"):
        time.sleep(0.01)
    parent.end(kill=True)
    assert capfd.readouterr() == ("", "")
