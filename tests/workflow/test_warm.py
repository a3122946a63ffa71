"""A job that is forked from a process with all imports is like one that was started by itself."""

import json
import os
import secrets
import signal
import subprocess
import sys
from pathlib import Path

import pytest
import warm
from helpers import ROOT, edit, skip, wait_for

if sys.platform != "linux":
    skip("only Linux has abstract sockets", "run it on Linux")

ENVIRONMENT = {
    **{name: value for name, value in os.environ.items() if not name.startswith("PYTEST")},
    "PYTHONPATH": f"{ROOT / 'scripts'}",
    **{f"{library}_THREADS": "1" for library in warm.LIBRARIES},
}
TELL = """
import json, os, random, signal, sys, tempfile
mask = os.umask(0)
print(json.dumps({
    "argv": sys.argv, "folder": os.getcwd(), "mask": mask, "name": __name__, "file": __file__,
    "path": sys.path, "stdin": sys.stdin.read(), "mine": os.environ.get("MINE"),
    "main": sys.modules["__main__"].__file__, "temporary": tempfile.gettempdir(),
    "signals": [str(signal.getsignal(s)) for s in (signal.SIGINT, signal.SIGTERM, signal.SIGCHLD)],
    "blocked": [int(s) for s in signal.pthread_sigmask(signal.SIG_BLOCK, [])],
    "files": sorted(int(fd) for fd in os.listdir("/proc/self/fd"))[:-1],
    "buffered": not sys.stdout.line_buffering,
}))
"""
FORKED = "import os; print('warm_process' in open(f'/proc/{os.getppid()}/cmdline').read())"


class Warm:
    """The process of one run of Snakemake, and the scripts of its jobs."""

    def __init__(self, folder: Path, modules=("json",), environment=ENVIRONMENT, jobs=9):
        self.scripts = folder / "with a space" / ".snakemake/scripts"
        self.scripts.mkdir(parents=True)
        self.name = f"pendula-test-{secrets.token_hex(8)}"
        self.environment = environment
        # as its jobs below: a shell lets what it starts in the background ignore Ctrl-C
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        self.process = warm._serve(self.name, environment, ["json"])
        signal.signal(signal.SIGINT, before)
        warm._tell(self.process, list(modules), jobs, folder / "imports.log")

    def start(self, body: str, asked=True, **changes) -> subprocess.Popen:
        script = self.scripts / f"{secrets.token_hex(4)}.job.py"
        script.write_text(body)
        prefix = warm._prefix(self.name) if asked else "set -euo pipefail;"
        return subprocess.Popen(
            ["bash", "-c", f"{prefix} {sys.executable} '{script}'"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            cwd=self.scripts,
            env={**self.environment, "TMPDIR": str(self.scripts), **changes},
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
        )

    def run(self, body: str, asked=True, **changes) -> tuple[int, str, str]:
        job = self.start(body, asked, **changes)
        out, error = job.communicate("given")
        return job.returncode, out, error


@pytest.fixture(scope="module")
def warm_one(tmp_path_factory):
    one = Warm(tmp_path_factory.mktemp("warm"))
    yield one
    warm.end(one.process)


def test_a_job_finds_what_its_command_would_have_given_it(warm_one):
    status, said, error = warm_one.run(TELL)
    cold_status, cold, _ = warm_one.run(TELL, asked=False)
    assert status == cold_status == 0, error
    told, expected = json.loads(said), json.loads(cold)
    for one in (told, expected):
        scripts = {one.pop("argv")[0], one.pop("file"), one.pop("main")}
        assert len(scripts) == 1 and Path(scripts.pop()).parent == warm_one.scripts
    assert told == expected
    assert warm_one.run(FORKED)[1] == "True\n"


@pytest.mark.parametrize(
    ("body", "status", "says"),
    [
        ("raise SystemExit(7)", 7, ""),
        ("raise SystemExit('enough')", 1, "enough"),
        ("1 / 0", 1, "ZeroDivisionError: division by zero"),
        ("import os; os.kill(os.getpid(), 9)", 128 + 9, ""),
        ("import atexit; atexit.register(print, 'late')", 0, ""),
    ],
)
def test_a_job_ends_as_its_command_would_have_ended(warm_one, body, status, says):
    warm_job, cold_job = warm_one.run(body), warm_one.run(body, asked=False)
    assert warm_job[0] == status and cold_job[0] in (status, 128 - status)
    assert warm_job[1] == cold_job[1] and says in warm_job[2]


@pytest.mark.parametrize("changes", [{"PENDULA_CACHE": "off"}, {"OMP_NUM_THREADS": "2"}])
def test_a_job_with_another_environment_starts_by_itself(warm_one, changes):
    assert warm_one.run(FORKED, **changes)[:2] == (0, "False\n")


def test_a_process_with_two_threads_forks_nothing(tmp_path):
    (tmp_path / "threaded.py").write_text(
        "import threading; threading.Thread(target=threading.Event().wait, daemon=True).start()"
    )
    one = Warm(tmp_path, ["threaded"], {**ENVIRONMENT, "PYTHONPATH": str(tmp_path)})
    try:
        assert one.run(FORKED)[:2] == (0, "False\n")
    finally:
        warm.end(one.process)


def test_what_jobs_import_leaves_one_thread(tmp_path):
    modules = warm.imports_of([ROOT / "scripts/figure.py"])
    assert "pendula.drawing.style" in modules and "job" in modules
    gate, last = tmp_path / "gate", modules[-1]
    os.mkfifo(gate)
    gate.with_suffix(".py").write_text(f"open({str(gate)!r}).read()")
    paths = {"PYTHONPATH": f"{ENVIRONMENT['PYTHONPATH']}{os.pathsep}{tmp_path}"}
    one = Warm(tmp_path, [*modules, "gate"], ENVIRONMENT | paths)
    try:
        gate.write_text("open")  # as soon as the process, which has imported all, is at the gate
        forked = f"{FORKED}; import sys; print({last!r} in sys.modules and 'xarray' in sys.modules)"
        assert one.run(forked)[1] == "True\nTrue\n"
    finally:
        warm.end(one.process)


def test_the_first_jobs_do_not_wait_for_all_that_is_imported(tmp_path):
    """The process waits at two gates while it imports; a client asks while it is at the first."""
    gates = [tmp_path / "first", tmp_path / "second"]
    for gate in gates:
        os.mkfifo(gate)
        gate.with_suffix(".py").write_text(f"open({str(gate)!r}).read()")
    one = Warm(tmp_path, ["first", "second"], {**ENVIRONMENT, "PYTHONPATH": str(tmp_path)})
    try:
        job = one.start("import sys; print([n in sys.modules for n in ('first', 'second')])")
        # the listener has a line of this name, and so has each client at its door
        wait_for(lambda: Path("/proc/net/unix").read_text().count(f"@{one.name}") > 1)
        gates[0].write_text("open")
        assert job.stdout.readline() == "[True, False]\n"
        gates[1].write_text("open")
        assert job.wait() == 0
    finally:
        warm.end(one.process)


@pytest.mark.parametrize("jobs", [0, 2])
def test_nothing_is_imported_for_no_job(tmp_path, jobs):
    imported = tmp_path / "imported"
    (tmp_path / "telling.py").write_text(f"open({str(imported)!r}, 'w')")
    paths = {**ENVIRONMENT, "PYTHONPATH": str(tmp_path)}
    one = Warm(tmp_path, ["telling"], paths, jobs)
    try:
        # while the first of two jobs runs, the process imports for the second
        wait = "" if not jobs else f"import os\nwhile not os.path.exists({str(imported)!r}): pass"
        assert one.run(wait)[0] == one.run("")[0] == 0
        assert imported.exists() == bool(jobs)
    finally:
        warm.end(one.process)


def test_a_module_that_fails_fails_in_the_jobs_that_need_it(tmp_path):
    (tmp_path / "broken.py").write_text("1 / 0")
    one = Warm(tmp_path, ["broken"], {**ENVIRONMENT, "PYTHONPATH": str(tmp_path)})
    try:
        assert one.run(FORKED)[:2] == (0, "True\n")
        status, _, error = one.run("import broken")
        assert status == 1 and "ZeroDivisionError" in error
    finally:
        warm.end(one.process)


def test_a_job_leaves_others_their_place_in_a_font_that_their_parent_holds_open(tmp_path):
    """Matplotlib's formulas hold fonts open, and read letters from wherever these are."""
    (tmp_path / "font.ttf").write_text("letters of a font")
    held = f"FONT = open({str(tmp_path / 'font.ttf')!r}, 'rb', buffering=0); FONT.seek(8)"
    (tmp_path / "holder.py").write_text(held)
    one = Warm(tmp_path, ["holder"], {**ENVIRONMENT, "PYTHONPATH": str(tmp_path)})
    try:
        wait_for(lambda: one.run("import sys; print('holder' in sys.modules)")[1] == "True\n")
        read = "import holder; print(holder.FONT.read(9).decode())"
        assert [one.run(f"{FORKED}; {read}")[1] for _ in range(2)] == ["True\nof a font\n"] * 2
    finally:
        warm.end(one.process)


WAIT = "import os, threading; print(os.getpid(), flush=True); threading.Event().wait()"
DEAF = f"import signal; signal.signal(signal.SIGTERM, signal.SIG_IGN); {WAIT}"


def is_gone(pid: int) -> bool:
    """Return whether a process has ended, buried or not."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] == "Z"
    except OSError:
        return True


@pytest.mark.parametrize("end", ["client", "Snakemake", "process"])
def test_no_job_outlives_who_waits_for_it(tmp_path, end, monkeypatch):
    """The process waits less here before it kills a job that does not end when it is asked."""
    hasty = tmp_path / "warm_process.py"
    hasty.write_text(warm.PROCESS.read_text())
    edit(hasty, "time.monotonic() + PATIENCE", "time.monotonic() + 0.2")
    monkeypatch.setattr(warm, "PROCESS", hasty)
    one = Warm(tmp_path)
    jobs = [one.start(body) for body in (WAIT, DEAF)]
    pids = [int(job.stdout.readline()) for job in jobs]
    if end == "client":
        for job in jobs:
            children = Path(f"/proc/{job.pid}/task/{job.pid}/children").read_text().split()
            os.kill(int(children[0]), signal.SIGKILL)
    elif end == "Snakemake":
        one.process.stdin.close()
    else:
        one.process.kill()
    wait_for(lambda: all(map(is_gone, pids)))
    assert all(job.wait() for job in jobs)
    warm.end(one.process)


def test_ctrl_c_that_only_the_client_hears_reaches_the_job(warm_one):
    body = f"import signal; signal.signal(signal.SIGTERM, signal.default_int_handler); {WAIT}"
    job = warm_one.start(body)
    pid = int(job.stdout.readline())
    children = Path(f"/proc/{job.pid}/task/{job.pid}/children").read_text().split()
    os.kill(int(children[0]), signal.SIGINT)
    assert job.wait() == 130 and is_gone(pid)


SNAKEFILE = """
import sys
from functools import partial
sys.path[:0] = {path!r}
import warm
rule all:
    input: "0.txt", "1.txt"
rule one:
    output: "{{n}}.txt"
    script: "job.py"
rule shell_job:
    output: "shell.txt"
    shell: "for word in a {{{{b,c}}}}; do echo $word; done > {{output}}"
warm._serve = partial(warm._serve, packages=["json"])  # not all that jobs of the project import
process = warm.begin()
onstart:
    warm.use(process, workflow, warm.Path("logs/imports.log"))
"""
JOB = f"{FORKED.replace('print(', 'told = str(')}\nopen(snakemake.output[0], 'w').write(told)"


def test_snakemake_asks_for_forks_and_leaves_nothing(tmp_path, monkeypatch):
    folder = tmp_path / "a 'quoted' folder"
    folder.mkdir()
    path = [str(ROOT / part) for part in ("workflow", "scripts")]
    (folder / "Snakefile").write_text(SNAKEFILE.format(path=path))
    (folder / "job.py").write_text(JOB)
    command = [sys.executable, "-m", "snakemake", "--cores", "1", "all", "shell.txt"]
    monkeypatch.chdir(folder)
    # not in a fork, where a fork in reserve would be asked for all this
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert [(folder / f"{n}.txt").read_text() for n in range(2)] == ["True", "True"]
    spent = json.loads((folder / "logs/imports.log").read_text().removeprefix("spent: "))
    assert spent.keys() == {"imports", "memory"} and all(value > 0 for value in spent.values())
    assert (folder / "shell.txt").read_text() == "a\nb\nc\n"
