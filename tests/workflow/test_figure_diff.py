"""The comparison with the baseline, and accepting, by the real snakemake."""

import json

from helpers import MY_BASELINE, edit, planned, snakemake
from PIL import Image
from PIL.PngImagePlugin import PngInfo

MINE = "--config", f"baseline={MY_BASELINE}"


def said(result) -> str:
    return result.stdout + result.stderr


def change_claims(finished, old: str, new: str) -> None:
    ledger = finished / "results/claims.json"
    text = ledger.read_text()
    assert old in text
    ledger.write_text(text.replace(old, new, 1))


def test_comparing_failing_and_accepting_by_name(accepted):
    finished, clone = accepted
    result = snakemake(clone, finished, "figure_diff", *MINE)
    assert result.returncode == 0, said(result)
    assert " identical; see results/figure_diff/index.html" in said(result)

    picture, baseline = finished / "results/figures/fig5.png", finished / MY_BASELINE
    with Image.open(picture) as image:
        darker = image.convert("RGB").point(lambda shade: shade * 0.8)
        about = PngInfo()
        for key, text in image.text.items():
            about.add_text(key, text)
    darker.convert("RGBA").save(picture, pnginfo=about, dpi=image.info["dpi"])
    (baseline / "checks/growth.nc").unlink()
    change_claims(finished, '"verdict": "confirmed"', '"verdict": "not reproduced"')
    result = snakemake(clone, finished, "figure_diff", *MINE)
    *_, first, second, third, judged, tally = said(result).rstrip().splitlines()
    faults = [first, second, third]
    assert result.returncode != 0 and "the accepted one" in judged
    assert tally.startswith("2 different, 1 damaged, ") and "index.html" in tally
    assert "Error" not in said(result) and "Traceback" not in said(result)
    assert faults[0].startswith("different: claims.json: ")
    assert 'verdict is "not reproduced" in place of "confirmed"' in faults[0]
    assert faults[1].startswith("different: figures/fig5.png: ") and "pixels differ" in faults[1]
    assert faults[2].startswith("damaged: checks/growth.nc: in the baseline is missing")
    page = (finished / "results/figure_diff/index.html").read_text()
    assert "Figure diff: 3 faults" in page

    # By name the ledger is accepted, and the picture is not.
    result = snakemake(clone, finished, "accept_figures", *MINE, "accept=claims")
    assert result.returncode == 0 and "in place of confirmed" in said(result)
    assert same("claims.json", finished / "results", baseline)
    assert not same("figures/fig5.png", finished / "results", baseline)


def same(name, *folders) -> bool:
    """Return whether a file is the same in two folders."""
    one, other = ((folder / name).read_bytes() for folder in folders)
    return one == other


def test_everything_that_a_full_run_makes_is_in_the_baseline(accepted_once):
    """What is left out is named here: times, logs, records, and what this machine alone makes.

    So are the parts of the ledger and its tables, which claims.json and tables/claims.md join.
    """
    finished = accepted_once / "finished"
    accepted = json.loads((finished / MY_BASELINE / "hashes.json").read_text())
    results = finished / "results"
    made = {path.relative_to(results).as_posix() for path in results.rglob("*") if path.is_file()}
    left = {name for name in made - accepted.keys() if name.split("/")[0] not in ("logs", "code")}
    known = {"report.html", *(name for name in left if name.startswith(("kernels/", "kept/")))}
    measured = {name for name in left if name.startswith(("truth/work_", "truth/speed_"))}
    joined = {name for name in left if name.startswith(("claims/", "tables/claims_"))}
    assert left == known | measured | joined
    assert accepted.keys() <= made


def test_a_quick_run_cannot_replace_the_committed_baseline(accepted):
    """Nor is a change of it shown; it has been accepted in a folder of its own."""
    finished, clone = accepted
    baseline = clone / "tests/baseline"
    before = {path: path.read_bytes() for path in baseline.rglob("*") if path.is_file()}
    for rule in ("preview_acceptance", "accept_figures"):
        result = snakemake(clone, finished, rule)
        assert result.returncode != 0 and "nothing is accepted" in said(result)
        assert "cases.fig2_small.end_time is 4.0 in place of 50.0" in said(result)
    assert before == {path: path.read_bytes() for path in baseline.rglob("*") if path.is_file()}


def test_a_name_of_nothing_stops_accepting_with_the_nearest(finished, clone):
    result = snakemake(clone, finished, "accept_figures", "--config", "accept=fig33")
    assert result.returncode != 0 and "fig33 names no file of a full run" in said(result)
    assert "did you mean fig3?" in said(result)


def test_a_value_of_bits_that_means_nothing_is_told(finished, clone):
    result = snakemake(clone, finished, "figure_diff", "--config", "bits=all")
    assert result.returncode != 0 and "the only value is bits=any" in said(result)


def test_it_compares_the_figures_of_the_list_alone(full_run, clone):
    assert planned(clone, full_run, "figure_diff") == {"compare_results": 1, "figure_diff": 1}
    edit(clone / "Snakefile", '    "bounds",\n', "")
    result = snakemake(clone, full_run, "--dry-run", "accept_figures", "--config", "accept=bounds")
    assert result.returncode != 0 and "bounds names no file of a full run" in said(result)
