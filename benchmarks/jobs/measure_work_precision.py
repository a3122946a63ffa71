"""Time every solver and every installed peer on the paper's cases, beside the errors they make."""

from pendula.datasets.netcdf import read, write
from pendula.problem import by_name

from benchmarks import machine
from benchmarks.contestants import find_peers
from benchmarks.problems import REGIME_OF, REGIMES, read_reference, until
from benchmarks.work_precision import measure


def measure_work_precision(
    references: list[str], problems: dict[str, dict], data: str, kernels: list[str] | tuple = ()
) -> None:
    """Measure the cases of `problems` against their `references`, in the same order."""
    cases, exact = {}, {}
    for (name, problem), path in zip(by_name(problems).items(), references, strict=True):
        horizon = REGIMES[REGIME_OF[name]].horizon
        cases[name], exact[name] = until(problem, horizon), read_reference(read(path), horizon)
    peers, absent = find_peers()
    for reason in absent.values():
        print(f"not measured: {reason}")
    variables = measure(cases, exact, peers, lambda text: print(text, flush=True))
    title = {"title": "Speed against error", "absent": "; ".join(absent.values())}
    write(data, variables, {**title, **machine.describe()})


if __name__ == "__main__":
    from job import run

    run(measure_work_precision, snakemake)  # noqa: F821
