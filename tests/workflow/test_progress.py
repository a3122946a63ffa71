"""What the screen shows while a run goes on, from records as Snakemake makes them."""

import io
import json
import logging
from types import SimpleNamespace

import progress
import pytest
import targets
from snakemake.logging import ColorizingTextHandler, DefaultFilter, DefaultFormatter
from snakemake.settings.enums import Quietness
from snakemake_interface_logger_plugins.common import LogEvent

AS_HERE = {Quietness.HOST, Quietness.REASON}
"""What profiles/default is quiet about."""


def record(event=None, message=None, **parts):
    parts = {"msg": message, "levelname": "INFO", "levelno": logging.INFO, **parts}
    return logging.makeLogRecord(parts | ({"event": event} if event else {}))


def starts(job, message="Drawing Fig 4"):
    names = {"rule_name": "fig4", "wildcards": {"case": "a"}, "reason": "x" * 999, "indent": False}
    return record(LogEvent.JOB_INFO, "", jobid=job, rule_msg=message, **names)


def ends(job):
    return record(LogEvent.JOB_FINISHED, f"Finished jobid: {job}", job_id=job)


def steps(done, total):
    return record(LogEvent.PROGRESS, done=done, total=total)


def screen(quiet=frozenset(AS_HERE), run=None, stream=None):
    made_by_snakemake = ColorizingTextHandler(
        stream=stream or io.StringIO(),
        formatter=DefaultFormatter(quiet),
        filter=DefaultFilter(quiet, False, False, False, False),
    )
    ours = progress.Screen(made_by_snakemake, quiet)
    ours.run = run or progress.Run({0: 0.0, 1: 30.0, 2: 30.0}, 2)
    return ours


def shown(ours, *records):
    for one in records:
        ours.handle(one)
    return ours.stream.getvalue().splitlines()


def test_each_job_is_one_line_with_its_place_and_the_time_that_is_left():
    lines = shown(screen(), starts(2), starts(1), ends(1), steps(1, 3), starts(0, "All is there"))
    assert lines[0] == "[1/3, about 30 s left] Drawing Fig 4"
    assert lines[1].startswith("[2/3, about ") and lines[1].endswith(" left] Drawing Fig 4")
    assert len(lines) == 3 and lines[2].endswith("] All is there")


def test_nothing_else_of_the_usual_course_is_shown():
    usual = ["Building DAG of jobs...", "Using shell: /usr/bin/bash", "Select jobs to execute..."]
    claims = record(LogEvent.RESOURCES_INFO, "Rules claiming more threads will be scaled down.")
    executes = record(LogEvent.JOB_STARTED, "Execute 2 jobs...", jobs=[1, 2])
    machine = record(LogEvent.WORKFLOW_STARTED)
    records = [*map(record, [None] * 3, usual), claims, machine, executes, steps(1, 3)]
    assert shown(screen({Quietness.REASON}), *records) == []


def test_errors_warnings_and_other_words_are_shown_as_snakemake_shows_them():
    error = {"rule_name": "fig4", "rule_msg": None, "jobid": 1, "input": [], "output": ["a.png"]}
    error |= {"log": ["a.log"], "conda_env": None, "shellcmd": None, "aux": {}}
    failed = record(LogEvent.JOB_ERROR, "Error", levelno=logging.ERROR, **error)
    lines = shown(screen(), starts(1), failed, record(None, "Exiting because a job failed"))
    assert "Error in rule fig4:" in lines and lines[-1] == "Exiting because a job failed"
    assert "    log: a.log (check log file(s) for error details)" in lines


@pytest.mark.parametrize(
    ("quiet", "expected"),
    [
        (AS_HERE | {Quietness.RULES}, ["1 of 3 steps (33%) done", "by the way"]),
        (AS_HERE | {Quietness.PROGRESS}, ["[1/3] Drawing Fig 4", "by the way"]),
        ({Quietness.ALL}, []),
        ({Quietness.HOST}, ["[1/3, about 30 s left] Drawing Fig 4", "    Reason: " + "x" * 999]),
    ],
)
def test_quiet_means_what_it_means_for_snakemake(quiet, expected):
    lines = shown(screen(quiet), starts(1), ends(1), steps(1, 3), record(None, "by the way"))
    assert lines[: len(expected)] == expected and ("by the way" in lines) == (lines != [])


def test_a_job_without_words_goes_by_its_rule_and_wildcards():
    assert shown(screen(), starts(1, None))[0].endswith("] fig4 a")


def test_a_job_that_is_started_once_more_keeps_its_place():
    error = record(LogEvent.JOB_ERROR, "", jobid=1)
    run = progress.Run({1: 1.0, 2: 1.0}, 1)
    for one in (starts(1), error, starts(2), starts(1)):
        run.follow(one)
    assert run.places == {1: 1, 2: 2} and set(run.running) == {1, 2}


@pytest.mark.parametrize("cores", [None, 2])
def test_where_the_time_is_not_known_none_is_told(cores):
    seconds = {1: 30.0, 2: None} if cores else {1: 30.0}
    run = progress.Run(seconds, cores)
    assert run.left() is None and progress.what_it_takes(run) == ""
    assert shown(screen(run=run), starts(1)) == [f"[1/{len(seconds)}] Drawing Fig 4"]


def test_jobs_are_expected_to_be_as_slow_as_those_before_but_not_for_one_that_compiled():
    run = progress.Run(dict.fromkeys(range(10), 10.0), 1)
    assert run.left() == 100.0
    run.took = dict.fromkeys(range(3), 20.0)
    assert run.left() == 140.0
    run.took = dict.fromkeys(range(3), 1e6)
    assert run.left() == progress.MOST * 70.0


def test_a_long_silence_ends_with_what_still_runs():
    ours = screen()
    first = shown(ours, starts(1), starts(2), ends(2))
    ours.remind()
    assert shown(ours) == first  # there was no silence
    ours.last -= 2 * progress.SILENCE
    ours.remind()
    ours.remind()
    assert shown(ours) == [*first, "still running: Drawing Fig 4 (0 s)"]


def jobs(log):
    return [SimpleNamespace(log=[str(log)] if log else [], jobid=1)]


def test_a_job_is_expected_to_take_what_it_took_here_or_in_the_accepted_run(tmp_path, monkeypatch):
    kept = {"warm": {"jobs": {"checks/lyapunov": {"wall": 7.0}, "imports": {"memory": 250}}}}
    (tmp_path / "kept.json").write_text(json.dumps({"runs": kept}))
    monkeypatch.setattr(targets, "ACCEPTED", tmp_path / "kept.json")
    log = tmp_path / "one.log"
    log.write_text("wall time: 30.0 s\n")
    of_chaos = "results/logs/checks/lyapunov.log"
    assert progress.expected(jobs(log), True) == {1: 30.0}
    assert progress.expected(jobs(of_chaos), True) == {1: 7.0}
    assert progress.expected(jobs(of_chaos), False) == {1: None}  # of another size
    assert progress.expected(jobs("results/logs/trajectories/mine.log"), True) == {1: None}
    assert progress.expected(jobs(None), True) == {1: 0.0}  # it only collects what others make


def test_a_run_takes_as_long_as_its_longest_job_or_as_all_on_their_cores():
    assert "about 30 s on 2 free" in progress.what_it_takes(progress.Run({1: 30.0}, 2))
    many = progress.Run(dict.fromkeys(range(60), 30.0), 2)
    assert "Expect about 15 min" in progress.what_it_takes(many)


def test_dry_runs_and_verbose_ones_keep_the_screen_of_snakemake(monkeypatch):
    plain = {"dryrun": False, "verbose": False, "debug_dag": False, "quiet": AS_HERE}
    theirs = ColorizingTextHandler(stream=io.StringIO())
    theirs.name = "DefaultStreamHandler"
    monkeypatch.setattr(progress.logger, "handlers", [theirs])
    for option in ("dryrun", "verbose", "debug_dag"):
        assert progress.take_the_screen(SimpleNamespace(**plain | {option: True})) is None
    assert progress.logger.handlers == [theirs]
    ours = progress.take_the_screen(SimpleNamespace(**plain))
    assert progress.logger.handlers == [ours] and ours.stream is theirs.stream
    monkeypatch.setattr(progress.logger, "handlers", [logging.NullHandler()])
    assert progress.take_the_screen(SimpleNamespace(**plain)) is None  # a plugin shows the run
