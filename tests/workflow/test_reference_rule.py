"""The rule `reference`: asked for by name only, and what it writes."""

from helpers import ROOT, jobs_in, package, planned, snakemake
from latticode.datasets.netcdf import read


def test_the_reference_has_six_cases_and_one_from_doubles(tmp_path, looked):
    plan = planned(ROOT, tmp_path, "reference")
    assert plan == {"reference": 1, "reference_case": 7}
    assert not plan.keys() & jobs_in((looked / "dry_run.txt").read_text()).keys()


def test_a_short_reference_by_the_real_snakemake(tmp_path):
    package("heyoka", "heyoka==7.13.2")
    target = "results/reference/fig4_small.double.nc"
    result = snakemake(ROOT, tmp_path, target)
    assert result.returncode == 0, result.stdout + result.stderr
    data = read(tmp_path / target)
    assert data.attrs["solver"] == "heyoka" and "doubles" in data.attrs["parameters_mean"]
    assert data["discrepancy"].max() < 1e-20
