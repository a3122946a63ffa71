"""Time every solver and installed peer on Newton's equations, beside the errors they make."""

from pendula.datasets.netcdf import read, write
from pendula.problem import by_name
from pendula.report.words import number, write_markdown

from benchmarks import machine
from benchmarks.pendula import TARGET, absent, measure
from benchmarks.tables import tabulate_pendula


def measure_pendula(problems: dict[str, dict], data: str, table: str) -> None:
    """Measure the pendula of the cases `problems`, and write a dataset and a page of Markdown."""
    for reason in absent().values():
        print(f"not measured: {reason}")
    variables = measure(by_name(problems), lambda text: print(text, flush=True))
    title = {"title": "Speed against error on the pendula", "absent": "; ".join(absent().values())}
    title["compared_at"] = number(TARGET)
    write(data, variables, {**title, **machine.describe()})
    write_markdown(table, *tabulate_pendula(read(data)))


if __name__ == "__main__":
    from job import run

    run(measure_pendula, snakemake)  # noqa: F821
