"""Take what a run made as the new baseline, or show what that would change."""

from pathlib import Path

from pendula.figure_diff.acceptance import plan, take


def accept_results(
    results: list[str],
    names: list[str],
    baseline: str,
    configuration: dict,
    all_of_it: bool,
    dry: bool,
) -> None:
    """Put the files `results` (results/topic/name) into `baseline`; first say what that changes.

    `names` are all files to be accepted, by their paths below results/: the whole run where
    `all_of_it`. The baseline loses those of them that `results` does not hold. If `dry`, nothing is
    changed.
    """
    made, folder = Path("results"), Path(baseline)
    made_names = [Path(path).relative_to(made).as_posix() for path in results]
    planned = plan(made_names, made, folder, configuration, None if all_of_it else names)
    print("\n".join(planned.lines))
    if dry:
        print("Nothing was changed; `snakemake accept_figures` makes these changes.")
    else:
        take(planned, made, folder)


if __name__ == "__main__":
    from job import run

    run(accept_results, snakemake)  # noqa: F821
