"""Jobs begin in the order that ends the run soonest."""

from collections import defaultdict
from types import SimpleNamespace

import order
import pytest
from snakemake.cli import get_argument_parser
from snakemake.scheduling.job_scheduler import JobRateLimiter
from snakemake.settings.types import MaxJobsPerTimespan


class Job:
    HIGHEST_PRIORITY = 1000

    def __init__(self, name, dag):
        self.name, self.dag = name, dag
        self.log = [f"results/logs/{name}.log"] if name != "all" else []

    @property
    def priority(self):
        return self.dag._priority[self]


class Dag:
    """Jobs a -> b -> all, c -> all and done -> all; `done` need not run again."""

    def __init__(self):
        self.jobs = {name: Job(name, self) for name in ("a", "b", "c", "done", "all")}
        self._priority = dict.fromkeys(self.jobs.values(), 0)
        later = {"a": "b", "b": "all", "c": "all", "done": "all"}
        self.depending = defaultdict(dict)
        for job, other in later.items():
            self.depending[self.jobs[job]] = {self.jobs[other]: set()}

    def needrun(self, job):
        return job.name != "done"

    def needrun_jobs(self):
        return filter(self.needrun, self.jobs.values())


@pytest.fixture
def dag(monkeypatch):
    monkeypatch.setattr(order, "accepted_seconds", lambda: {"a": 2.0, "b": 3.0, "c": 4.0})
    return Dag()


def priorities(dag):
    order.put_in_order(dag)
    return {job.name: job.priority for job in dag.jobs.values()}


def test_the_longest_way_to_the_end_begins_first(dag):
    assert priorities(dag) == {"a": 5.0, "b": 3.0, "c": 4.0, "done": 0, "all": 0.0}


def test_what_never_ran_and_what_the_user_asks_for(dag, monkeypatch):
    monkeypatch.setattr(order, "accepted_seconds", lambda: {"b": 3.0})
    dag._priority[dag.jobs["c"]] = Job.HIGHEST_PRIORITY
    found = priorities(dag)
    assert found["a"] == order.UNKNOWN + 3.0 and found["c"] == Job.HIGHEST_PRIORITY


@pytest.mark.parametrize(
    ("words", "limited"), [([], False), (["--max-jobs-per-timespan", "2/1m"], True)]
)
def test_jobs_wait_for_no_second_to_pass_unless_the_user_asks(words, limited):
    given = get_argument_parser().parse_args(words).max_jobs_per_timespan
    if isinstance(given, str):  # the default, as Snakemake's command line leaves it
        given = MaxJobsPerTimespan.parse_choice(given)
    scheduler = SimpleNamespace(job_rate_limiter=JobRateLimiter(given))
    order.begin_at_once(scheduler)
    assert bool(scheduler.job_rate_limiter) == limited
