"""Run seeded ensembles of chaotic cases and sweeps from data that differ in their last digits."""

from pendula.datasets.netcdf import write
from pendula.problem import by_name
from pendula.studies.chaos.ensembles import case_bands, sweep_moments


def measure_ensembles(
    data: str,
    problems: dict[str, dict],
    members: int,
    swept_problems: dict[str, dict],
    half_widths: list[int],
    windows: list[tuple[float, float]],
    swept_members: int,
    size: float,
    seed: int,
    kind: str = "even",
    kernels: list[str] | tuple = (),
) -> None:
    """Run `members` of each case and `swept_members` of each sweep, perturbed by `size`.

    `kind` is that of the ensemble, "even" in n or "uneven".
    """
    drawn = {"size": size, "seed": seed, "kind": kind}
    cases, shared = case_bands(by_name(problems), members=members, **drawn)
    swept = by_name(swept_problems)
    sweeps = sweep_moments(swept, half_widths, windows, members=swept_members, **drawn)
    shared["ensemble"] = f"{kind} in n"
    counts = {"members": members, "swept_members": swept_members}
    write(data, cases | sweeps, {**shared, "perturbation": size, "seed": seed, **counts})


if __name__ == "__main__":
    from job import run

    run(measure_ensembles, snakemake)  # noqa: F821
