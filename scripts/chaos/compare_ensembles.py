"""Compare ensembles of the chaotic cases and sweeps with the paper's own runs among them."""

from pendula.datasets.checks import describe
from pendula.datasets.netcdf import read, save
from pendula.studies.chaos.ensembles import compare, mismatched


def compare_ensembles(
    ensembles: str,
    lyapunov: str,
    runs: list[str],
    references: list[str],
    cases: list[str],
    sweeps: list[str],
    windows: dict[str, str],
    data: str,
) -> None:
    """Write the dataset; `runs` and `references` are of `cases`, `sweeps` those of `windows`."""
    own = dict(zip(cases, map(read, runs), strict=True))
    known = dict(zip(cases, map(read, references), strict=True))
    swept = dict(zip(windows, map(read, sweeps), strict=True))
    drawn = read(ensembles)
    found = compare(drawn, own, known, swept, windows)
    found["mismatched"] = mismatched(drawn["case"].values, read(lyapunov))
    print(describe("ensembles of the chaotic cases", found.to_dict()))
    save(data, found)


if __name__ == "__main__":
    from job import run

    run(compare_ensembles, snakemake)  # noqa: F821
