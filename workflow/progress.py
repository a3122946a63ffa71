"""What the screen shows of a run: a line for each job, how many there are, and how long they take.

Snakemake tells of each job in six lines: a date, a number, that it selects jobs, that it executes
some. Here a job is one line as it starts, such as

    [12/65, about 40 s left] Drawing Fig 4, norms against time

and while nothing else happens, a line now and then says what still runs. Errors are shown as
Snakemake shows them. So are dry runs and calls with --verbose, and its log file holds what it
always does. `--quiet rules` leaves out the lines of jobs, `--quiet progress` the times.
"""

import logging
import threading
import time
from collections.abc import Collection, Iterable, Mapping

from snakemake.logging import ColorizingTextHandler, get_event, is_quiet_about, logger
from snakemake_interface_logger_plugins.common import LogEvent
from targets import accepted_seconds, seconds_of

NOISE = (
    *("Assuming unrestricted", "Building DAG", "Using shell", "Conda environments: ignored"),
    *("Select jobs", "Rules claim"),
)
"""How messages begin that come with every run and tell nothing of this one."""

MOST = 3.0
"""Jobs are expected to be at most so many times slower or faster than before."""

SILENCE = 15.0
"""After so many seconds without a line the screen shows what still runs."""

ENOUGH = 3
"""So many jobs must have ended before the others are expected to be as slow as these were."""


class Run:
    """How far the jobs of a run are, by their numbers."""

    def __init__(self, seconds: Mapping[int, float | None], cores: int | None):
        """Expect each job to take `seconds`, where that is known; `cores` is None on a cluster."""
        self.seconds, self.cores = seconds, cores
        self.places: dict[int, int] = {}
        self.running: dict[int, tuple[str, float]] = {}
        self.took: dict[int, float] = {}

    def follow(self, record: logging.LogRecord) -> None:
        """Take down that a job starts or has ended."""
        event, now = get_event(record), time.monotonic()
        if event == LogEvent.JOB_INFO:
            self.places.setdefault(record.jobid, len(self.places) + 1)
            self.running[record.jobid] = (name_of(record), now)
        elif event == LogEvent.JOB_FINISHED and record.job_id in self.running:
            self.took[record.job_id] = now - self.running.pop(record.job_id)[1]
        elif event == LogEvent.JOB_ERROR:
            self.running.pop(record.jobid, None)

    def left(self) -> float | None:
        """Return in how many seconds all will be done, or None where that is not known."""
        times = [self._left_of(job) for job in self.seconds if job not in self.took]
        if self.cores is None or None in times:
            return None
        return max([sum(times) / self.cores, *times])

    def _left_of(self, job: int) -> float | None:
        if (expected := self.seconds[job]) is None:
            return None
        since = time.monotonic() - self.running[job][1] if job in self.running else 0.0
        return max(0.0, expected * self._pace() - since)

    def _pace(self) -> float:
        """Return how much slower than expected the jobs are that have ended."""
        known = [job for job in self.took if self.seconds.get(job)]
        if len(known) < ENOUGH:
            return 1.0
        took, expected = (sum(each[job] for job in known) for each in (self.took, self.seconds))
        return min(max(took / expected, 1 / MOST), MOST)

    def place(self, job: int, timed: bool) -> str:
        """Return which of the jobs this one is, and how long all that is left will take."""
        of = f"{self.places[job]}/{max(len(self.seconds), len(self.places))}"
        left = self.left() if timed else None
        return f"[{of}, {in_words(left)} left]" if left else f"[{of}]"

    def still(self) -> str:
        """Return what runs, and for how long."""
        now = time.monotonic()
        parts = [f"{name} ({now - start:.0f} s)" for name, start in self.running.values()]
        return f"still running: {'; '.join(parts)}" if parts else ""


class Screen(ColorizingTextHandler):
    """Takes the place of the handler by which Snakemake writes to the screen."""

    def __init__(self, replaced: ColorizingTextHandler, quiet: Collection):
        """Write where `replaced` does, in its colours, and leave out what it leaves out."""
        super().__init__(replaced.nocolor, replaced.stream, replaced.formatter)
        self.filters, self.name, self.quiet = replaced.filters, replaced.name, quiet
        self.run, self.last = Run({}, None), time.monotonic()

    def begin(self, run: Run) -> None:
        """Count the jobs of `run` from now on, and watch them."""
        self.run = run
        if not is_quiet_about(self.quiet, "progress"):
            threading.Thread(target=self._watch, daemon=True).start()

    def handle(self, record: logging.LogRecord) -> bool:
        """Follow the jobs, also those that nobody wants to see."""
        self.run.follow(record)
        return super().handle(record)

    def emit(self, record: logging.LogRecord) -> None:
        """Write a line for a job that starts, and of all else what tells something."""
        event = get_event(record)
        if event == LogEvent.JOB_INFO:
            self._write(self.decorate(record, self._line(record)))
        elif not self._is_noise(event, record):
            self.last = time.monotonic()
            super().emit(record)

    def _is_noise(self, event: LogEvent | None, record: logging.LogRecord) -> bool:
        if event == LogEvent.PROGRESS:
            return not is_quiet_about(self.quiet, "rules")  # else the lines of jobs tell it
        if event in (LogEvent.WORKFLOW_STARTED, LogEvent.JOB_STARTED, LogEvent.JOB_FINISHED):
            return True
        return event in (None, LogEvent.RESOURCES_INFO) and str(record.msg).startswith(NOISE)

    def _line(self, record: logging.LogRecord) -> str:
        timed = not is_quiet_about(self.quiet, "progress")
        line = f"{self.run.place(record.jobid, timed)} {name_of(record)}"
        why = "" if is_quiet_about(self.quiet, "reason") else f"\n    Reason: {record.reason}"
        return line + why

    def _write(self, text: str) -> None:
        with self._output_lock:
            self.last = time.monotonic()
            self.stream.write(f"{text}\n")
            self.flush()

    def _watch(self) -> None:
        while True:
            time.sleep(SILENCE / 5)
            self.remind()

    def remind(self) -> None:
        """Say what still runs if nothing else was said for a while."""
        if time.monotonic() - self.last > SILENCE and (still := self.run.still()):
            self._write(still)


def name_of(record: logging.LogRecord) -> str:
    """Return what a job does, as its rule says, or the name of the rule."""
    return record.rule_msg or " ".join([record.rule_name, *map(str, record.wildcards.values())])


def in_words(seconds: float) -> str:
    """Return a time as it is told: roughly."""
    if seconds < 10:
        return "a few s"
    return f"about {seconds:.0f} s" if seconds < 90 else f"about {seconds / 60:.0f} min"


def take_the_screen(settings) -> Screen | None:
    """Return our handler in the place of Snakemake's, or None where that is to stay."""
    if settings.dryrun or settings.verbose or settings.debug_dag:
        return None
    for handler in logger.handlers:
        if handler.name == "DefaultStreamHandler":  # absent where a plugin writes to the screen
            screen = Screen(handler, settings.quiet or ())
            logger.handlers[logger.handlers.index(handler)] = screen
            return screen
    return None


def expected(jobs: Iterable, sizes_are_accepted: bool) -> dict[int, float | None]:
    """Return how long each job will take by its number, or None where that is not known.

    Each takes as long as it took in this folder, or else in the accepted run if it is of the same
    size as there. What has no log has nothing to do.
    """
    accepted = accepted_seconds() if sizes_are_accepted else {}
    return {job.jobid: seconds_of(job.log[0], accepted) if job.log else 0.0 for job in jobs}


def what_it_takes(run: Run) -> str:
    """Return how long all jobs of a run will take, or nothing where that is not known."""
    if not (left := run.left()):
        return ""
    return f"Expect {in_words(left)} on {run.cores} free cores, from how long jobs took before."
