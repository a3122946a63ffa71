"""The order of jobs: first comes the one from which the longest way leads to the end of the run.

With few cores, a run takes longest where a long chain of jobs begins late and ends alone. How long
a job takes is known from an earlier run, in this folder or of the accepted results.
"""

from targets import accepted_seconds, seconds_of

UNKNOWN = 1.0
"""Seconds of a job that never ran."""


def put_in_order(dag) -> None:
    """Give each job that will run the seconds from its start to the end of the run as priority.

    Snakemake asks a priority of each rule, before it knows which of its jobs will run. A job that
    the user asked for by --prioritize keeps the highest one.
    """
    ways, accepted = {}, accepted_seconds()

    def way(job) -> float:
        if job not in ways:
            own = seconds_of(job.log[0], accepted) if job.log else 0.0
            later = [way(other) for other in dag.depending[job] if dag.needrun(other)]
            ways[job] = (UNKNOWN if own is None else own) + max(later, default=0.0)
        return ways[job]

    for job in list(dag.needrun_jobs()):
        if job.priority != job.HIGHEST_PRIORITY:
            dag._priority[job] = way(job)
