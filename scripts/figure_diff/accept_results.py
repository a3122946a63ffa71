"""Take what a run made, or some of its files, as the new baseline."""

from pathlib import Path

from pendula.figure_diff.acceptance import accept


def accept_results(
    results: list[str], words: list[str], baseline: str, configuration: dict
) -> None:
    """Put the files `results` (results/topic/name), or those that `words` name, into `baseline`."""
    names = [path.removeprefix("results/") for path in results]
    print(accept(names, Path("results"), Path(baseline), configuration, words))


if __name__ == "__main__":
    from job import run

    run(accept_results, snakemake)  # noqa: F821
