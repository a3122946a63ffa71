"""Edited cases of the paper: what they once broke runs on what the case has become, in one run.

Every key of every case is edited in tests/edits.py, which takes half an hour.
"""

import yaml
from edits import EDITS
from helpers import ROOT, command_of, run_ready
from pendula.configuration.cases import Case
from pendula.datasets.netcdf import read

EDITED = {
    "fig2_small": {"end_time": 6, "boundary": "free"},
    "fig2_large": {"half_width": 20},
    "fig3_small": {"epsilon": 2, "snapshot_step": None},
    "fig3_large": {"initial": {1: [1, "0.5j"], -3: [0.2, 0]}},
    "fig4_small": {"omega": 7.5, "gamma": 0.5, "solver": "auto"},
    "fig4_large": {"initial": {0: [1, 1]}, "output_step": 0.05},
}
FIGURES = ("fig3", "front")
DATASETS = ("checks/members", "checks/lyapunov", "checks/ensemble_runs", "breathers/sensitivity")
DATASETS += ("unbounded/map_fig6_right", "pendula/phases", "pendula/over_the_top")


def test_every_key_of_a_case_is_edited_three_times():
    assert EDITS.keys() == Case.model_fields.keys()
    assert {len(values) for values in EDITS.values()} == {3}


def test_studies_run_on_what_the_cases_have_become(finished):
    (edit := finished / "edit.yaml").write_text(yaml.safe_dump({"cases": EDITED}))
    targets = [f"results/figures/{name}.png" for name in FIGURES]
    targets += [f"results/{name}.nc" for name in DATASETS]
    command = command_of(ROOT, finished, ROOT / "config/quick.yaml", *targets)
    ended = run_ready([*command, str(edit)])
    assert ended.returncode == 0, ended.stdout + ended.stderr
    phases = read(finished / "results/pendula/phases.nc")["larger_modulus"]
    assert phases.sel(case="fig2_large").dropna("site")["site"].values[[0, -1]].tolist() == [
        -20,
        20,
    ]
    assert phases.sel(case="fig2_small").notnull().all() and phases["site"][-1] == 30
    lyapunov = read(finished / "results/checks/lyapunov.nc")
    assert lyapunov["gamma"].sel(case=["fig2_small", "fig4_small"]).values.tolist() == [1.0, 0.5]
