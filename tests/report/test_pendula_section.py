"""The section on the pendula: numbers of short runs, and films as the page's script reads them."""

import base64

import figure_fixtures
import made_up_report as made_up
import made_up_unbounded
import numpy as np
import pytest
from pendula.datasets.netcdf import as_xarray
from pendula.studies.pendula import phases_section
from pendula.studies.pendula.film import film_pendula


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """Return results of short runs of two cases, of which one goes over the top."""
    cases = {
        name: figure_fixtures.short_case(name).changed(model="pendula", mu=0.2)
        for name in ("fig2_small", "fig4_large")
    }
    sea, passages = figure_fixtures.pendula_sea()
    datasets = {
        "pendula/phases": figure_fixtures.pendula_phases(),
        "pendula/sea": sea,
        "pendula/over_the_top": passages,
        "pendula/film": as_xarray(*film_pendula(cases, 2, 3, 6)),
        "unbounded/thermal": made_up_unbounded.thermal(),
    }
    return made_up.MadeUp(tmp_path_factory.mktemp("page"), datasets)


def test_passages_are_told_with_their_limits(results):
    passages = phases_section.phases(results)["passages"]
    below, over = passages["rows"]
    assert below[0] == "0.15" and below[1].text.startswith("0 % (0 %")
    assert below[2].text == "not by then"
    assert over[1].text.startswith("100 % (") and float(over[2].text) < 5.0


def test_the_sea_stands_beside_the_thermal_one(results):
    told = phases_section.phases(results)["sea"]
    assert [name for name, _ in told["powers"]] == ["amplitudes (4)", "μ = 0.15"]
    power = results["pendula/sea"]["site_power"].mean("member").values
    shown = [
        float(quote.text.split("\N{NO-BREAK SPACE}")[0].split("±")[0])
        for _, quote in told["powers"]
    ]
    assert shown == pytest.approx(power, rel=0.2)


def test_norms_are_told_where_the_runs_reach_the_papers_window(results):
    assert phases_section.phases(results)["rows"] == []


def test_a_film_is_a_byte_for_each_angle(results):
    film, data = phases_section.film(results), results["pendula/film"]
    assert (film["sites"], film["count"], film["per_period"]) == (5, 19, 6)
    for player, case in zip(film["players"], data["case"].values, strict=True):
        steps = np.frombuffer(base64.b64decode(player["frames"]), np.int8)
        assert (steps == data["angle_step"].sel(case=case).values.ravel()).all()
        hanging = player["rows"][0][2]
        angle = np.pi / 127 * float(data["angle_step"].sel(case=case)[-1, 0, 2])
        assert hanging["x"] - hanging["from"] == pytest.approx(48.0 * np.sin(angle), abs=0.06)
        assert hanging["y"] - hanging["hook"] == pytest.approx(48.0 * np.cos(angle), abs=0.06)
        assert player["step"] * 6 == pytest.approx(float(data["tau_of_period"].sel(case=case)))
