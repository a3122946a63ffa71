"""Compare what a run made with the accepted baseline, and write a page and a verdict on it."""

from pathlib import Path

from pendula.datasets import complete_or_absent
from pendula.datasets.json_files import write_json
from pendula.figure_diff import comparison_page
from pendula.figure_diff.baseline import compare


def compare_results(
    results: list[str],
    baseline: str,
    configuration: dict,
    any_bits: bool,
    rests_on_chaos: list[list[str]],
    html: str,
    verdict: str,
) -> None:
    """Compare the files `results` with the folder `baseline`; the end of a run tells its faults."""
    names = [path.removeprefix("results/") for path in results]
    made, folder = Path("results"), Path(baseline)
    found = compare(names, made, folder, configuration, any_bits, rests_on_chaos)
    with complete_or_absent(html) as partial:
        partial.write_text(comparison_page.render(found, made, folder), "utf-8")
    write_json(verdict, {"faults": found.faults, "counts": found.counts, "lines": found.lines})


if __name__ == "__main__":
    from job import run

    run(compare_results, snakemake)  # noqa: F821
