"""Members of ensembles: what each is reduced to, and how widely they scatter."""

import numpy as np
import pytest
from latticode.datasets.netcdf import as_xarray
from latticode.equations.ensembles import draw_members
from latticode.simulation.simulate import simulate
from latticode.simulation.sweep import pair_l2
from pendula.studies.chaos import members
from problems import problem_of

SOLVER = {"name": "dop853", "rtol": 1e-9, "atol": 1e-9}
WINDOWS = [(1.0, 2.0), (2.0, 4.0)]
PROBLEM = problem_of(
    "fig4_small", half_width=6, end_time=4.0, output_step=0.25, solver=SOLVER, snapshot_every=1
)


def test_every_case_has_all_numbers():
    runs = members.measure_members({"a": PROBLEM, "b": PROBLEM}, WINDOWS, 1e-3, 3, 7)
    data = as_xarray(*runs.make())
    assert data["window"].values.tolist() == ["[1, 2]", "[2, 4]"]
    l2 = np.array([pair_l2(simulate(member)) for member in draw_members(PROBLEM, 1e-3, 3, 7)])
    late = l2[:, 2, 8:]
    width = np.sqrt(np.var(late, axis=0, ddof=1).mean()) / np.mean(late)
    np.testing.assert_allclose(data["relative_width"], width)
    np.testing.assert_array_equal(
        data["l2"].sel(case="a", quantile=0.5), np.median(l2[:, :2], axis=0)
    )
    assert data["l2_start"][0] == pytest.approx(np.hypot(1, 0.1)) and data["linf_start"][0] == 1.0
    np.testing.assert_array_equal(data["l2_level"].sel(case="a"), data["l2_level"].sel(case="b"))
    rms = data["rms"].transpose("case", "member", "window", "component", "site").values
    np.testing.assert_array_equal(rms, rms[..., ::-1])
