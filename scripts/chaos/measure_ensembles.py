"""Run seeded ensembles of chaotic cases and sweeps from data that differ in their last digits."""

from pendula.datasets.netcdf import write
from pendula.datasets.trajectories import describe_cases
from pendula.problem import by_name
from pendula.studies.chaos.ensembles import TITLE, Swept, case_bands, sweep_moments


def measure_ensembles(
    data: str,
    problems: dict[str, dict],
    members: int,
    swept: dict[str, dict],
    windows: list[tuple[float, float]],
    size: float,
    seed: int,
    kind: str = "even",
    kernels: list[str] | tuple = (),
) -> None:
    """Run `members` of each case and those of each sweep, perturbed by `size`.

    `swept` gives by sweep its problem, half-widths and members at each of them.
    `kind` is that of the ensemble, "even" in n or "uneven". There may be no cases.
    """
    drawn = {"size": size, "seed": seed, "kind": kind}
    own = by_name({name: one["problem"] for name, one in swept.items()})
    runs = {
        name: Swept(own[name], one["half_widths"], one["members"]) for name, one in swept.items()
    }
    cases, shared = {}, {"title": TITLE, **describe_cases(own)[1]}
    if problems:
        cases, shared = case_bands(by_name(problems), members=members, **drawn)
        shared["members"] = members
    shared["ensemble"] = f"{kind} in n"
    about = {**shared, "perturbation": size, "seed": seed}
    write(data, cases | sweep_moments(runs, windows, **drawn), about)


if __name__ == "__main__":
    from job import run

    run(measure_ensembles, snakemake)  # noqa: F821
