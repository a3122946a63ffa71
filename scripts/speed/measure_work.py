"""Time every solver and every installed peer on the paper's cases, beside the errors they make."""

from pendula.datasets.files import complete_or_absent
from pendula.datasets.netcdf import read, write
from pendula.speed import machine
from pendula.speed.contestants import find_peers
from pendula.speed.regimes import REGIME_OF, REGIMES
from pendula.speed.tables import write_tables
from pendula.speed.tasks import set_task
from pendula.speed.work import measure


def measure_work(
    references: list[str], problems: dict[str, dict], data: str, table: str, kernels: list[str] = ()
) -> None:
    """Measure the cases of `problems` against their `references`, in the same order."""
    tasks, norms = [], {}
    for (name, problem), path in zip(problems.items(), references, strict=True):
        reference = read(path)
        horizon = REGIMES[REGIME_OF[name]].horizon
        at = reference["snapshot_tau"].values == horizon
        re, im = reference["amplitude"].isel(snapshot=at).squeeze("snapshot").values
        tasks.append(set_task(name, problem, horizon, re + 1j * im))
        norms[name] = reference["linf"].values, reference["l2"].values
    peers, absent = find_peers()
    for reason in absent.values():
        print(f"not measured: {reason}")
    variables = measure(tasks, norms, peers, lambda text: print(text, flush=True))
    write(data, variables, {"absent": "; ".join(absent.values()), **machine.describe()})
    with complete_or_absent(table) as partial:
        partial.write_text(write_tables(read(data)), encoding="utf-8")


if __name__ == "__main__":
    from job import run

    run(measure_work, snakemake)  # noqa: F821
