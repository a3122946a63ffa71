"""The chances that another right run turns a verdict, of runs that are all the accepted one."""

import right_runs
from accepted import BASELINE
from latticode.datasets.json_files import load_json
from pendula.jobs.decide import all_claims


def test_equal_runs_turn_nothing_and_a_wrong_one_is_told(tmp_path, monkeypatch):
    path = tmp_path / "right_runs.json"
    assert right_runs.keep_chances([BASELINE] * 2, path) == []
    rows = load_json(path)["rows"]
    assert {row["claim"] for row in rows} == {claim.name for claim in all_claims()}
    assert {row["chance"] for row in rows} == {0.0}

    of_claims = right_runs.look_at(BASELINE)
    wrong = of_claims["fig6_constant"] | {"": of_claims["fig5_decreases"][""]}
    runs = iter([of_claims, of_claims | {"fig6_constant": wrong}])
    monkeypatch.setattr(right_runs, "look_at", lambda _: next(runs))
    (row,) = right_runs.keep_chances([BASELINE] * 2, path)
    assert row["claim"] == "fig6_constant" and row["chance"] == 0.5
