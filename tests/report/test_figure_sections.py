"""The sections on the figures, the motion and the claims, on made-up results."""

import base64

import made_up_report as made_up
import numpy as np
import pytest
import xarray as xr
from pendula.ledger import section as claims
from pendula.studies.paper import (
    section_motion as motion,
)
from pendula.studies.paper import (
    section_norms as norms,
)
from pendula.studies.paper import (
    section_sweeps as sweeps,
)


def observed(**changes) -> xr.Dataset:
    regions = ["theorem 1", "theorem 1", "theorem 2 widened", "none"]
    ratios = changes.get("ratio", [0.5, 0.25, 0.125, 0.75])
    return made_up.by_case(region=("case", regions), ratio=("case", ratios))


def run_of(steps: int) -> xr.Dataset:
    return xr.Dataset(attrs={"steps": steps})


@pytest.mark.parametrize(("scale", "shown"), [(1.0, "0.600 to 1.00"), (2.0, "1.20 to 2.00")])
def test_norms_are_read_from_their_datasets(tmp_path, scale, shown):
    results = made_up.MadeUp(
        tmp_path,
        {
            "figures/fig2": made_up.norms(scale, divergence_time=3.5),
            "checks/cases": observed(),
            "trajectories/fig2_small": run_of(120),
            "trajectories/fig2_large": run_of(450),
        },
    )
    figure = norms._figure(results, 2)
    small, large = figure["rows"]
    assert [str(cell) for cell in small[1:]] == [
        *(shown, f"{0.6 * scale:#.3g}", "never", "Theorem 1", "0.5", "120")
    ]  # fmt: skip
    assert str(large[3]) == "3.5" and large[3].link == "figures/fig2.nc"
    assert len(figure["divergences"]) == 1 and shown.split()[0][:3] in figure["picture"].alt


def sweep(right: list[float]) -> xr.Dataset:
    widths = [5, 10, 20, 40, 80, 160]
    flat = np.full((2, 2, 6), 2.0)
    flat[1, 0] = right
    return xr.Dataset(
        {
            "l2": (("panel", "reading", "half_width"), flat),
            "omega": ("panel", [-4.0, 0.0]),
            "initial": ("panel", [made_up.SMALL, made_up.SMALL]),
            "statistic": ("reading", ["max", "mean"]),
            "window": ("reading", ["[10, 50]", "[10, 50]"]),
        },
        coords={"panel": ["left", "right"], "reading": ["text", "caption"], "half_width": widths},
    )


def samples(mean: float) -> dict[str, xr.Dataset]:
    numbers = {"l2_mean": mean, "l2_deviation": 2.0, "swept_run": 7.0, "swept_omega": 0.0}
    drawn = {name: (("sweep", "half_width"), [[value]]) for name, value in numbers.items()}
    drawn |= {"swept_omega": ("sweep", [0.0]), "swept_initial": ("sweep", [made_up.SMALL])}
    coords = {"sweep": ["fig5_right"], "half_width": [160]}
    members = xr.Dataset(attrs={"swept_members": 8})
    return {"figures/ensembles": xr.Dataset(drawn, coords=coords), "checks/ensembles": members}


def plain(text) -> str:
    return str(text).replace("\N{NO-BREAK SPACE}", " ")


@pytest.mark.parametrize(
    ("values", "shape", "level"),
    [
        ([1, 2, 4, 7, 7, 7], "grows", "level from M = 40"),
        ([1, 2, 3, 4, 5, 7], "grows", "not level by the end"),
        ([2, 2, 9, 7, 3, 3], "rises to 9.00 at M = 20 and falls again", "not level by the end"),
        ([9, 8, 7, 7, 7, 7], "falls", "level from M = 20"),
        ([7, 7, 7, 7, 7, 7], "stays as it is", "level from M = 5"),
    ],
)
def test_the_way_of_a_sweep_is_found_from_its_numbers(tmp_path, values, shape, level):
    results = made_up.MadeUp(tmp_path, {"figures/fig5": sweep(values), **samples(10.0)})
    figure = sweeps._figure(results, 5)
    curve = figure["l2"][2]
    assert str(curve["shape"]) == shape and plain(curve["level"]) == level
    assert curve["by_text"] and curve["shape"].link == "figures/fig5.nc"
    assert len(figure["rows"]) == 4 and str(figure["widths"]) == "6"


@pytest.mark.parametrize(("mean", "off", "below"), [(10.0, "1.5", True), (5.0, "1", False)])
def test_a_chaotic_run_is_set_beside_its_ensemble(tmp_path, mean, off, below):
    results = made_up.MadeUp(tmp_path, {"figures/fig5": sweep([1] * 6), **samples(mean)})
    (sample,) = sweeps._figure(results, 5)["samples"]
    assert (str(sample["off"]), sample["below"], str(sample["runs"])) == (off, below, "8")


def moving_chain() -> xr.Dataset:
    modulus = np.zeros((2, 3, 4))
    modulus[0, 1] = [1.0, 2.0, 2.0, 2.0]
    modulus[1, 2, 2:] = 1.5
    return xr.Dataset(
        {
            "modulus": (("component", "site", "snapshot"), modulus),
            "snapshot_tau": ("snapshot", [0.0, 0.5, 1.0, 1.5]),
        },
        coords={"component": ["A", "B"], "site": [-1, 0, 1]},
        attrs={"omega": 0.0, "initial": made_up.SMALL},
    )


def test_the_run_to_play_is_quantised_time_after_time(tmp_path):
    results = made_up.MadeUp(tmp_path, {"trajectories/a": moving_chain()})
    shown = motion.played(results, "trajectories/a")
    frames = np.frombuffer(base64.b64decode(shown["frames"]), np.uint8).reshape(4, 2, 3)
    assert shown["count"] == 4 and shown["step"] == 0.5 and str(shown["peak"]) == "2"
    assert frames[:, 0, 1].tolist() == [128, 255, 255, 255]
    assert frames[2:, 1, 2].tolist() == [191, 191]
    assert shown["still"] == 2 and str(shown["still_tau"]) == "1"  # two of three sites move
    assert shown["bars"][0] == [0.0, 1.0, 0.0]


def test_the_ledger_is_shown_and_counted(tmp_path):
    rows = [
        made_up.claim("a", place="Section 5, Fig 5 left"),
        made_up.claim("b", "not reproduced", because="the l2 norm grows"),
    ]
    results = made_up.MadeUp(
        tmp_path, {"checks/chart": xr.Dataset()}, **{"claims.json": made_up.ledger(*rows)}
    )
    shown = claims.gather(results)
    assert str(shown["total"]) == "2"
    assert {verdict: str(number) for verdict, number in shown["counts"]} == {
        "confirmed": "1", "confirmed with a caveat": "0", "not reproduced": "1",
        "cannot be decided": "0",
    }  # fmt: skip
    assert shown["rows"][1]["because"] == "the ℓ² norm grows"
    assert shown["rows"][0]["measured"] == "largest rate = 0.25"
    assert shown["rows"][0]["criterion"] == "largest rate ≤ 0.001"
    assert shown["rows"][0]["data"][0].link == "checks/chart.nc"
    assert shown["by_figure"][5] == [("confirmed", 1)] and shown["by_figure"][6] == []


def test_numbers_of_the_ledger_link_to_what_decides_them(tmp_path):
    rows = [made_up.claim("a", measured={"x": 1.5, "y": "none"}), made_up.claim("b", measured={})]
    results = made_up.MadeUp(
        tmp_path, {"checks/chart": xr.Dataset()}, **{"claims.json": made_up.ledger(*rows)}
    )
    ledger = claims.Ledger(results)
    assert ledger.quote("a", "x") == ("1.5", "checks/chart.nc")
    assert np.isnan(ledger.value("a", "y")) and np.isnan(ledger.value("b", "x"))
    assert ledger.holds("a") and ledger.verdict("b") == "confirmed"
