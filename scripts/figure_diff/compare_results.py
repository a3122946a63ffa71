"""Compare what a run made with the accepted baseline, and write a page and a verdict on it."""

from pathlib import Path

from pendula.datasets import complete_or_absent
from pendula.figure_diff import comparison_page, dump
from pendula.figure_diff.baseline import compare, environment, recorded


def compare_results(
    results: list[str],
    baseline: str,
    configuration: dict,
    html: str,
    verdict: str,
    accepted: list[str] | tuple = (),
) -> None:
    """Compare the files `results` (results/topic/name) with the folder `baseline`.

    `accepted` are the files of that folder; the rule names them so that a change of one reruns this
    job. Faults do not fail it, so that Snakemake keeps the page; they fail the rule figure_diff.
    """
    made, folder = Path(results[0]).parts[0], Path(baseline)
    names = [Path(path).relative_to(made).as_posix() for path in results]
    found = compare(names, Path(made), folder, configuration)
    with complete_or_absent(html) as new_html, complete_or_absent(verdict) as new_verdict:
        page = comparison_page.render(found, Path(made), folder, _note(folder))
        new_html.write_text(page, "utf-8")
        dump(found, new_verdict)


def _note(folder: Path) -> str:
    then, now = recorded(folder)["environment"], environment()
    if then == now:
        return "Where data are the accepted ones, pictures are compared pixel by pixel."
    changed = [f"{key} {then.get(key)} to {now[key]}" for key in now if then.get(key) != now[key]]
    return f"Pictures compared by their look: the environment changed ({', '.join(changed)})."


if __name__ == "__main__":
    from job import run

    run(compare_results, snakemake)  # noqa: F821
