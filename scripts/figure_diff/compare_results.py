"""Compare what a run made with the accepted baseline, and write a page and a verdict on it."""

from pathlib import Path

from pendula.datasets import complete_or_absent
from pendula.figure_diff import comparison_page
from pendula.figure_diff.baseline import compare


def compare_results(
    results: list[str],
    baseline: str,
    configuration: dict,
    html: str,
    verdict: str,
    accepted: list[str] | tuple = (),
    any_bits: bool = False,
) -> None:
    """Compare the files `results` (results/topic/name) with the folder `baseline`.

    `accepted` are the files of that folder; the rule names them so that a change of one reruns this
    job. With `any_bits` the allowances decide about files that do not have the accepted bits.
    Faults do not fail this job, so that Snakemake keeps the page; they fail the rule figure_diff.
    """
    made, folder = Path(results[0]).parts[0], Path(baseline)
    names = [Path(path).relative_to(made).as_posix() for path in results]
    found = compare(names, Path(made), folder, configuration, any_bits)
    with complete_or_absent(html) as new_html, complete_or_absent(verdict) as new_verdict:
        new_html.write_text(comparison_page.render(found, Path(made), folder), "utf-8")
        comparison_page.dump(found, new_verdict)


if __name__ == "__main__":
    from job import run

    run(compare_results, snakemake)  # noqa: F821
