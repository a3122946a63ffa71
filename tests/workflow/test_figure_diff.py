"""The comparison with the baseline, and accepting, by the real snakemake."""

import os

from helpers import MY_BASELINE, edit, snakemake
from latticode.datasets.json_files import load_json

MINE = "--config", f"baseline={MY_BASELINE}"


def output(result) -> str:
    return result.stdout + result.stderr


def flip(path) -> None:
    """Flip one bit of a file and keep its time, as a disk may."""
    times, content = os.stat(path), bytearray(path.read_bytes())
    content[len(content) // 2] ^= 1
    path.write_bytes(content)
    os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))


def test_comparing_failing_and_accepting_by_name(finished, clone):
    """It compares every file, and Snakemake reruns no job for a file with a flipped bit.

    The report is written again with other wall times of jobs, which are not compared.
    """
    results = finished / "results"
    log, report = results / "logs/claims.log", results / "report.html"
    log.write_text(log.read_text() + "wall time: 1234.5 s, largest memory: 90 MB\n")
    report.unlink()
    result = snakemake(clone, finished, "figure_diff", *MINE)
    assert result.returncode == 0, output(result)
    assert f" identical; see {results}/figure_diff/index.html" in output(result)
    assert b"1234.5" in report.read_bytes()

    flipped = ["checks/threshold.nc", "claims/theory.json", "figures/fig5.png", "report.html"]
    for name in flipped:
        flip(results / name)
    (finished / MY_BASELINE / "tables/claims.md").write_text("edited")
    result = snakemake(clone, finished, "figure_diff", *MINE)
    *faults, judged, tally = output(result).rstrip().splitlines()[-7:]
    assert result.returncode != 0 and "the accepted one" in judged
    assert tally.startswith("1 different, 4 damaged, ") and "index.html" in tally
    assert "Error" not in output(result) and "Traceback" not in output(result)
    assert [fault.split(": ")[:2] for fault in faults] == [
        ["different", "report.html"],
        *(["damaged", name] for name in sorted([*flipped[:3], "tables/claims.md"])),
    ]
    assert "in the baseline was edited since it was accepted" in faults[-1]
    assert "Figure diff: 5 faults" in (results / "figure_diff/index.html").read_text()

    # A changed table is accepted by its name, although other files are damaged.
    table = results / "tables/claims.md"
    table.write_text(table.read_text() + "changed")
    result = snakemake(clone, finished, "accept_figures", *MINE, "accept=tables/claims")
    assert result.returncode == 0 and "1 files accepted, 1 of them new or changed" in output(result)
    assert (finished / MY_BASELINE / "tables/claims.md").read_text().endswith("changed")


def test_everything_that_a_full_run_makes_is_in_the_baseline(full_run):
    """Left out are logs, what this machine alone makes, copies of the baseline, and the archive."""
    accepted = load_json(full_run / MY_BASELINE / "hashes.json")["files"]
    results = full_run / "results"
    files = {path.relative_to(results).as_posix() for path in results.rglob("*") if path.is_file()}
    left = {name for name in files - accepted.keys() if not name.startswith("logs/")}
    assert {name.split("/")[0] for name in left} == {"archive", "kernels", "quoted"}
    assert accepted.keys() <= files


def test_a_quick_run_cannot_replace_the_committed_baseline(full_run, clone):
    baseline = clone / "tests/baseline"
    before = {path: path.read_bytes() for path in baseline.rglob("*") if path.is_file()}
    result = snakemake(clone, full_run, "--dry-run", "accept_figures")
    assert result.returncode != 0 and "nothing is accepted" in output(result)
    assert "cases.fig2_small.end_time is 4.0 in place of 50.0" in output(result)
    assert before == {path: path.read_bytes() for path in baseline.rglob("*") if path.is_file()}


def test_a_value_of_bits_that_means_nothing_is_told(full_run, clone):
    result = snakemake(clone, full_run, "figure_diff", "--config", "bits=all")
    assert result.returncode != 0 and "the only allowed value is any" in output(result)


def test_it_compares_the_figures_of_the_list_alone(full_run, clone):
    edit(clone / "Snakefile", '    "bounds",\n', "")
    result = snakemake(clone, full_run, "--dry-run", "accept_figures", "--config", "accept=bounds")
    assert result.returncode != 0 and "bounds names no file of a full run" in output(result)
