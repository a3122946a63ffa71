"""The sections on chaos, growth, the solvers and the theory, on made-up results."""

import made_up_report as made_up
import numpy as np
import pytest
import xarray as xr
from made_up_chaos import lifetimes
from pendula.ledger import section as claims
from pendula.studies.chaos import section as chaos
from pendula.studies.paper import section as paper
from pendula.studies.theory import section as theory
from pendula.studies.unbounded import section as growth

TAU = np.linspace(0.0, 10.0, 11)


def chaotic_results(folder, rate: float, lost: float, until: float = 10.0) -> made_up.MadeUp:
    by_parity, by_solver = ("case", "parity"), ("case", "level", "solver")
    rates = np.array([[0.001, 0.002]] * 3 + [[rate, rate / 2]])
    growing = made_up.by_case(
        exponent=(by_parity, rates),
        exponent_error=(by_parity, rates / 10),
        chaotic=("case", [0, 0, 0, int(rate > 1.0)]),
    )
    horizons = np.full((4, 1, 2), np.inf)
    horizons[3, 0] = [lost, 2 * lost]
    coords = {"solver": ["ode45", "taylor"], "level": ["visible"], "tau": TAU}
    trust = made_up.by_case(
        horizon=(by_solver, horizons),
        size=("level", [0.01]),
        decimal_horizon=("decimal_level", [2.0, 5.0]),
        decimal_size=("decimal_level", [1e-12, 0.01]),
        known_until=(("case", "solver"), np.full((4, 2), until)),
        run_end=("case", [10.0] * 4),
        proved_until=("case", [10.0, np.nan, 10.0, 7.5]),
    )
    inside = {"run_inside": 0.875, "band_width": 0.3, "band_middle": 10.0}
    ensembles = made_up.by_case(
        {"fig3_large": (-4.0, made_up.LARGE)},
        **{name: ("case", [value]) for name, value in inside.items()},
        band_share=0.9,
    )
    widths = {"width_ratio": 1.4, "width_ratio_low": 1.2, "width_ratio_high": 1.6}
    members = made_up.by_case(
        {"fig3_large": (-4.0, made_up.LARGE)},
        **{name: ("case", [value]) for name, value in widths.items()},
    )
    rounded = made_up.by_case(rounded_time=("case", [np.inf, np.inf, np.inf, 6.5]))
    run = xr.Dataset(attrs={"omega": 0.0})
    return made_up.MadeUp(
        folder,
        {
            "checks/lyapunov": growing.assign_coords(parity=["even", "odd"]),
            "checks/trust": trust.assign_coords(coords),
            "checks/ensemble_runs": ensembles.assign_attrs(members=32, perturbation=1e-7),
            "checks/symmetry": rounded,
            "checks/members": members,
            "checks/lifetimes": lives(),
            "trajectories/fig4_small": run.assign_attrs(omega=1.0),
            chaos.PRINTED: run,
        },
    )


def lives() -> xr.Dataset:
    """Return the made-up lives of the figure, and the same rates by two tolerances."""
    by_choice = {"choice_rate": 0.01, "choice_rate_low": 0.005, "choice_rate_high": 0.02}
    made = lifetimes().assign(
        compared_amplitude=7.0,
        choice_tolerance=("choice", [1e-5, 1e-8]),
        choice_kind=("choice", ["even", "uneven"]),
        choice_drift=("choice", [1e-4, 1e-7]),
        choice_work=("choice", [100, 200]),
        **{name: ("choice", [value, value]) for name, value in by_choice.items()},
    )
    return made.assign_attrs(members=64)


def gathered(results: made_up.MadeUp) -> dict:
    return chaos.gather(results, None)


def test_the_proofs_are_counted_with_their_ends(tmp_path):
    results = chaotic_results(tmp_path, 2.5, 4.5)
    found = gathered(results)
    assert {key: str(words) for key, words in found["proved"].items()} == {
        "count": "3",
        "until": "7.5 to 10",
    }
    assert str(found["ends"]) == "10"
    results[chaos.TRUST]["proved_until"][:] = np.nan
    assert str(gathered(results)["proved"]["until"]) == "none"


def test_a_double_is_no_tenth(tmp_path):
    found = gathered(chaotic_results(tmp_path, 2.5, 4.5))["decimal"]
    assert (str(found["first"]), str(found["seen"]), found["omega"]) == ("2", "5", "0")
    assert found["first"].link == "checks/trust.nc"


@pytest.mark.parametrize(("rate", "lost", "count"), [(2.5, 4.5, "1"), (0.05, 8.25, "0")])
def test_chaos_is_told_from_the_rates(tmp_path, rate, lost, count):
    found = gathered(chaotic_results(tmp_path, rate, lost))
    assert str(found["count"]) == count and str(found["cases"]) == "4"
    assert len(found["chaotic"]) == int(count)
    assert str(found["lost"]["ode45"]["times"]) == f"{lost:.3f}"
    assert str(found["lost"]["taylor"]["kept"]) == "3"
    row = [str(cell) for cell in found["rows"][3]]
    assert row[3:] == [f"{lost:g}", f"{2 * lost:g}", "6.5"]


@pytest.mark.parametrize(
    ("until", "said", "counts"),
    [
        (10.0, "never", ("3", "0", "0")),
        (8.0, "not by 8, the reference's end", ("0", "3", "0")),
        (np.nan, "no reference", ("0", "0", "4")),
    ],
)
def test_never_is_told_from_not_known(tmp_path, until, said, counts):
    results = chaotic_results(tmp_path, 2.5, np.nan if np.isnan(until) else 4.5, until)
    found = gathered(results)
    lost = found["lost"]["ode45"]
    assert tuple(str(lost[name]) for name in ("kept", "ended", "unknown")) == counts
    assert str(found["rows"][0][3]) == said


def test_a_band_is_as_wide_as_its_quantiles(tmp_path):
    (band,) = gathered(chaotic_results(tmp_path, 2.5, 4.5))["ensembles"]
    assert (str(band["width"]), str(band["middle"])) == ("30 %", "10")
    assert (str(band["share"]), str(band["inside"])) == ("90 %", "88 %")


def test_the_ratio_of_widths_stands_with_its_limits(tmp_path):
    (one,) = gathered(chaotic_results(tmp_path, 2.5, 4.5))["widths"]
    assert (str(one["ratio"]), str(one["limits"])) == ("1.4", "1.20 to 1.60")


def test_a_life_that_outlasts_the_runs_is_bounded(tmp_path):
    found = gathered(chaotic_results(tmp_path, 2.5, 4.5))["lives"]
    at_once, some, never = ([str(cell) for cell in row] for row in found["rows"])
    assert at_once == ["1", "5", "5", "0 %", "5", *["none"] * 3]
    assert some[1:5] == ["50", "50 to over 100", "50 %", "50.5"]
    assert some[5:] == ["0.01", "0.005 to 0.02", "0.3"]
    assert never[1:5] == ["over 100", "over 100", "100 %", "over 100"]
    assert never[5:] == ["0", "0 to 0.001", "none"]
    assert [str(cell) for cell in found["choices"][1]][:2] == ["10⁻⁸", "uneven in n"]


def growing_results(folder, last: float, **measured) -> made_up.MadeUp:
    cases = {"fig4_small": (0.0, made_up.SMALL)}
    law = made_up.by_case(
        cases,
        l2_exponent=(("case", "octave"), [[0.6, last]]),
        l2_exponent_error=(("case", "octave"), [[0.01, 0.01]]),
        l2=(("case", "band", "point"), np.full((1, 1, 2), 206.0)),
    ).assign_coords(band=["mean"])
    speeds = {"corrected_speed": 3.0, "corrected_speed_error": 0.01, "predicted_speed": 3.0}
    powers = {"mean_power": 18.0, "mean_power_error": 0.1, "expected_power": 20.0}
    powers |= {"slope_power": 18.1, "slope_power_error": 0.1}
    lengths = xr.Dataset({"correlation_length": ("omega", [2.0])}, coords={"omega": [0.0]})
    front = {name: ("omega", [value]) for name, value in (speeds | powers).items()}
    window = xr.Dataset(coords={"half_width": [5, 10], "end": [12.0, 150.0]})
    width = {"tau": ("tau", [0.0, 400.0]), "width": ("piece", [64, 1280])}
    run = xr.Dataset(width, attrs={"omega": 0.0})
    names = ("unbounded_in_time", "unbounded_maximum", "unbounded_large",
             "ensemble_fig5_conjecture", "ensemble_fig6_diverges", "unbounded_window",
             "unbounded_front", "unbounded_equilibrium", "unbounded_slope",
             "unbounded_warm")  # fmt: skip
    rows = [made_up.claim(n, decided_by=["unbounded/fig4_small"], measured=measured) for n in names]
    return made_up.MadeUp(
        folder,
        {
            "unbounded/growth": law,
            "unbounded/thermal": lengths,
            "unbounded/front": xr.Dataset(front, coords={"omega": [0.0]}),
            "unbounded/fig4_small": run,
            **dict.fromkeys(growth.MAPS, window),
        },
        **{"claims.json": made_up.ledger(*rows)},
    )


@pytest.mark.parametrize(("power", "grows"), [(0.5, True), (0.01, False)])
def test_growth_is_told_from_the_last_octave(tmp_path, power, grows):
    results = growing_results(tmp_path, power, exponent=power, error=0.002, end=400.0, sites=2329.0)
    found = growth.gather(results, claims.Ledger(results))
    (case,) = found["cases"]
    assert case["grows"] is grows and found["main"]["near"] is grows
    assert [str(cell).replace("\N{NO-BREAK SPACE}", " ") for cell in case["row"][1:]] == [
        *("400", "1280", "206", f"0.600, {power:.3f}", f"{power:.3f} ± 0.010")
    ]  # fmt: skip
    assert str(found["speed_ratio"]) == "1.000" and str(found["power_ratio"]) == "0.90"
    assert found["fronts"][0][5] == ("20", "unbounded/front.nc")
    assert str(found["fronts"][0][4]).replace("\N{NO-BREAK SPACE}", " ") == "18.10 ± 0.10"


def test_runs_that_are_too_short_tell_no_power(tmp_path):
    results = growing_results(tmp_path, 0.5)
    found = growth.gather(results, claims.Ledger(results))
    assert not found["main"]["known"] and not found["tries_known"]


def test_the_solvers_are_held_to_what_the_paper_states(tmp_path):
    late = np.array([[1.5e-6, 1e-9]] * 3 + [[3e-6, 1e-9]])
    drifts = np.stack([0.5 * late, late], axis=-1)
    by_solver = ("case", "solver", "span")
    solvers = made_up.by_case(
        largest_drift=(by_solver, drifts),
        kept=(by_solver, (drifts < 2e-6).astype(int)),
        stated_drift=("case", [1e-6] * 4),
        allowed_drift=("case", [2e-6] * 4),
        until=(("case", "span"), [[10.0, 50.0]] * 4),
        divergence_time=(("case", "pair"), [[np.inf]] * 3 + [[7.5]]),
        largest_difference=(("case", "pair"), [[0.02]] * 3 + [[0.4]]),
        visible=0.01,
    ).assign_coords(
        solver=["ode45", "crank_nicolson"],
        span=["early", "whole"],
        pair=["ode45 - crank_nicolson"],
    )
    grid = ("case", "scheme", "step")
    steps = made_up.by_case(scheme_difference=(grid, np.full((4, 2, 2), 0.02))).assign_coords(
        scheme=["crank_nicolson", "implicit_midpoint"], step=[0.0025, 0.00125]
    )
    steps.attrs["configured_step"] = 0.0025
    datasets = {"checks/solvers": solvers, "checks/second_solver": steps}
    datasets["checks/lyapunov"] = made_up.lyapunov("fig3_large")
    found = paper.gather_solvers(made_up.MadeUp(tmp_path, datasets), None)
    assert not found["coarse"]  # the regular cases differ less than the chaotic one
    datasets["checks/lyapunov"] = made_up.lyapunov("fig2_large")
    assert paper.gather_solvers(made_up.MadeUp(tmp_path, datasets), None)["coarse"]
    names = ("kept", "kept_early", "early", "end", "cases", "apart", "first", "allowed")
    assert [str(found[name]) for name in names] == ["3", "4", "10", "50", "4", "1", "7.5", "2"]
    assert [str(row[-1]) for row in found["drift"]] == ["yes", "yes", "yes", "no"]
    assert str(found["drift"][3][-2]) == "yes"
    assert str(found["agreement"][3][1]) == "7.5" and found["visible"] == "1 %"
    assert len(found["schemes"]["head"]) == len(found["schemes"]["rows"][0]) == 4


@pytest.mark.parametrize(("largest", "faults"), [(0.5, 0), (1.5, 1)])
def test_a_check_above_its_tolerance_is_counted(tmp_path, largest, faults):
    attrs = {"long_name": "largest P over its bound", "units": "1", "tolerance": 1.0}
    results = made_up.MadeUp(
        tmp_path, {"checks/worst": xr.Dataset({"ratio": ("sample", [0.25, largest], attrs)})}
    )
    (row,) = theory._rows(results, "checks/worst")
    assert row["holds"] is not bool(faults)
    assert str(row["cells"][1]) == f"{largest:g}" and str(row["cells"][2]) == "1"


@pytest.mark.parametrize(("printed", "fails"), [(-0.14, True), (0.02, False)])
def test_errata_follow_from_their_checks(tmp_path, printed, fails):
    constant = xr.Dataset(
        {"printed": ("n", [0.02, printed]), "corrected": ("n", [0.04, 0.04]), "smallest": 3}
    )
    numbers = {"start": 1.01, "delta_0": 0.4, "depth": 6.62, "barrier": 4.0}
    given = {"constants": {"omega": -4.0}, "pair": ["(1+0j)", "(0.1+0j)"]}
    widened = {"widened_delta_0": 1.34, "widened_bound": 3.39}
    pair = {"allowed_power": 2.0, "breaking": 27.7, "barrier_power": 4.0}
    rows = [
        made_up.claim("bootstrap", "not reproduced", because="it assumes what it proves"),
        made_up.claim("slow_time", measured={"order": 3.0, "order_without_the_half": 1.0}),
        *(made_up.claim(f"fig{n}_caption") for n in (5, 6)),
        made_up.claim("lost", "not reproduced", because="Omega is -4"),
    ]
    results = made_up.MadeUp(
        tmp_path,
        {
            "checks/theorem_3_constant": constant,
            "checks/theorem_2_case": xr.Dataset(numbers | widened),
            "checks/cases": made_up.by_case(),
            "checks/bootstrap": xr.Dataset(pair),
            "checks/chart": xr.Dataset(),
        },
        **{"claims.json": made_up.ledger(*rows)},
    )
    results.settings = {"theory": {"theorem_2_case": given}}
    found = theory.gather_errata(results, claims.Ledger(results))
    assert found["case"]["name"].replace("\N{NO-BREAK SPACE}", " ") == "Ω = −4, (A₀, B₀) = (1, 0.1)"
    assert found["constant"]["fails"] is fails and str(found["constant"]["sites"]) == "3"
    assert not found["case"]["covered"] and found["case"]["covered_widened"]
    assert found["bootstrap"]["verdict"] == "not reproduced" and "27.7" in made_up.text_of(
        found["bootstrap"]
    )
    assert not found["case"]["shallow"]
    assert [row["because"] for row in found["missed"]] == ["it assumes what it proves", "Ω is −4"]


def test_the_largest_amplitudes_are_tabled_beside_the_thermal_ones(tmp_path):
    measured = {"of_1_sites": 3.4147, "of_64_sites": 5.2044, "norm_over_thermal": 0.98847}
    measured |= {"thermal_of_1_sites": 3.42252, "thermal_of_64_sites": 5.2160}
    measured |= {"norm_over_thermal_error": 0.0034}
    results = growing_results(tmp_path, 0.5, **measured)
    results[growth.MAIN]["neighbours"] = ("neighbours", [1, 64])
    found = growth.gather(results, claims.Ledger(results))["maximum"]
    assert found["known"] and str(found["norm"]).split() == ["0.988", "±", "0.003"]
    rows = [[str(cell) for cell in row] for row in found["sizes"]]
    assert rows == [["1", "3.415", "3.423"], ["64", "5.204", "5.216"]]
