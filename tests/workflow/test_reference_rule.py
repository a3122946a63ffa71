"""The rule `reference`: asked for by name only."""

from helpers import ROOT, jobs_in, planned


def test_the_reference_has_six_cases_and_no_full_run_makes_them(tmp_path, looked):
    plan = planned(ROOT, tmp_path, "reference")
    assert plan == {"reference": 1, "reference_case": 6}
    assert not plan.keys() & jobs_in((looked / "dry_run.txt").read_text()).keys()
