"""Integrate problems on chains without ends, each as a seeded ensemble, into one dataset."""

from pathlib import Path

from job import step
from pendula.datasets.netcdf import write
from pendula.problem import Problem
from pendula.studies.unbounded.active_sites import run_long
from pendula.studies.unbounded.long_runs import Ensemble, attributes, member, run_variables


def spread_case(
    data: str,
    name: str,
    problems: list[dict],
    rest: float,
    members: int,
    perturbation: float,
    seed: int,
    checkpoints: str = "",
    kernels: list[str] | tuple = (),
) -> None:
    """Write the series of each problem and member; `checkpoints` is where to keep unfinished ones.

    An interrupted job continues from there, and gives the same numbers to the last bit.
    """
    runs, kept, varied = [], [], [Problem.of(problem) for problem in problems]
    ensemble = Ensemble(members, perturbation, seed)
    for variant, problem in enumerate(varied):
        runs.append([])
        for number in range(members):
            kept.append(Path(checkpoints, f"{name}-{variant}-{number}.npz"))
            started = problem.changed(initial=member(problem.initial, ensemble, number))
            runs[-1].append(run_long(started, rest, kept[-1] if checkpoints else None))
            step(f"{name}: member {number + 1} of {members} of problem {variant + 1} done")
    title = f"Norms, front and final states of {name} on chains without ends"
    write(data, run_variables(varied, runs), attributes(title, name, varied, rest, ensemble))
    for path in kept:
        path.unlink(missing_ok=True)


if __name__ == "__main__":
    from job import run

    run(spread_case, snakemake)  # noqa: F821
