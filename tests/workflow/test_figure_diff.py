"""The comparison with the baseline by the real snakemake."""

from helpers import edit, planned, snakemake
from PIL import Image


def test_accepting_comparing_and_failing(finished, clone):
    assert snakemake(clone, finished, "accept_figures").returncode == 0
    result = snakemake(clone, finished, "figure_diff")
    assert result.returncode == 0 and " identical; see results/figure_diff/index.html" in (
        result.stdout + result.stderr
    )

    picture = finished / "results/figures/fig5.png"
    with Image.open(picture) as image:
        darker = image.convert("RGB").point(lambda shade: shade * 0.8)
    darker.save(picture)
    (clone / "tests/baseline/checks/growth.nc").unlink()
    result = snakemake(clone, finished, "figure_diff")
    said = (result.stdout + result.stderr).splitlines()
    faults = [line for line in said if line.startswith(("different: ", "extra: "))]
    assert result.returncode != 0 and len(faults) == 2
    assert faults[0].startswith("different: figures/fig5.png: ") and "pixels differ" in faults[0]
    assert faults[1] == "extra: checks/growth.nc: is not in the baseline"
    page = (finished / "results/figure_diff/index.html").read_text()
    assert "Figure diff: 2 faults" in page


def test_it_compares_the_figures_of_the_list_and_is_no_part_of_a_full_run(finished, clone):
    assert planned(clone, finished) == {}
    assert planned(clone, finished, "figure_diff") == {"compare_results": 1, "figure_diff": 1}
    edit(clone / "Snakefile", '    "bounds",\n', "")
    assert snakemake(clone, finished, "accept_figures").returncode == 0
    accepted = {path.stem for path in (clone / "tests/baseline/figures").glob("*.png")}
    assert "fig6" in accepted and "bounds" not in accepted
