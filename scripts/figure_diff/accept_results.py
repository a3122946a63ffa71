"""Take what a run made as the new baseline."""

from pathlib import Path

from pendula.figure_diff.baseline import accept


def accept_results(results: list[str], baseline: str) -> None:
    """Put the files `results` (results/topic/name) into `baseline`, and say what changed."""
    made = Path(results[0]).parts[0]
    names = [Path(path).relative_to(made).as_posix() for path in results]
    changed = accept(names, Path(made), Path(baseline))
    print("\n".join(changed) if changed else "The baseline is as it was.")


if __name__ == "__main__":
    from job import run

    run(accept_results, snakemake)  # noqa: F821
