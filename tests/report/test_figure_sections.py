"""The sections on the figures, the motion and the claims, on made-up results."""

import base64
import re

import made_up_report as made_up
import numpy as np
import pytest
import xarray as xr
from jinja2 import Environment, FileSystemLoader, StrictUndefined
from made_up_breathers import sensitivity
from pendula.ledger import section as claims
from pendula.report import page
from pendula.studies.paper import motion
from pendula.studies.paper import section as paper
from pendula.studies.paper.section_breathers import beside_breathers


def observed(**changes) -> xr.Dataset:
    regions = ["theorem 1", "theorem 1", "theorem 2 widened", "none"]
    ratios = changes.get("ratio", [0.5, 0.25, 0.125, 0.75])
    return made_up.by_case(region=("case", regions), ratio=("case", ratios))


def run_of(size: str, scale: float) -> xr.Dataset:
    """Return a run whose norms fall from `scale`, for large data from five times that."""
    falling = scale * np.array([1.0, 0.8, 0.6, 0.6, 0.6]) * (5.0 if size == "large" else 1.0)
    norm = (("component", "tau"), np.stack([falling, 0.0 * falling]))
    attributes = {"omega": 8.0, "initial": made_up.SMALL, "solver": "ode45", "steps": 120}
    attributes |= {"solver_rtol": 1e-7}
    return xr.Dataset({"l2": norm, "linf": norm}, {"tau": np.linspace(0.0, 4.0, 5)}, attributes)


def trusted_until(time: float, until: float = 4.0) -> xr.Dataset:
    """Return horizons of runs to tau = 4 where run and reference are known `until` then."""
    horizons = np.array([np.inf, time, np.inf, np.inf])[:, None, None]
    trust = made_up.by_case(
        horizon=(("case", "level", "solver"), np.where(np.isnan(until), np.nan, horizons)),
        known_until=(("case", "solver"), np.full((4, 1), until)),
        run_end=("case", [4.0] * 4),
        size=("level", [0.01]),
    )
    return trust.assign_coords(solver=["ode45"], level=["visible"])


def norms_results(
    folder, trust: xr.Dataset, scale: float = 1.0, chaotic=("fig2_large",), **attributes
) -> made_up.MadeUp:
    """Return the results of Fig 2; `attributes` are those of its runs, not of those judged."""
    judged = {f"fig2_{size}.ode45": run_of(size, scale) for size in ("small", "large")}
    own = {name.partition(".")[0]: run.assign_attrs(attributes) for name, run in judged.items()}
    runs = {f"trajectories/{name}": run for name, run in {**judged, **own}.items()}
    ensembles = xr.Dataset(coords={"case": ["fig3_large"]})
    datasets = {"checks/cases": observed(), paper.TRUST: trust, paper.ENSEMBLES: ensembles}
    datasets["checks/lyapunov"] = made_up.lyapunov(*chaotic)
    return made_up.MadeUp(folder, datasets | runs)


def caption(figure: dict) -> str:
    """Return what the page says of a figure of norms."""
    folders = [page.STUDIES, page.HERE / "templates"]
    templates = Environment(loader=FileSystemLoader(folders), trim_blocks=True)
    part = templates.get_template("paper/section.html.j2").module
    visible = {"visible": "1 %", "ensemble": {"share": "90 %", "runs": "32"}}
    shown = {"chain": figure["picture"], "norms": [figure], "sweeps": [], "verdicts": {2: []}}
    return re.sub("<[^>]*>", "", str(part.figures(visible | shown)))


@pytest.mark.parametrize(
    ("trust", "attributes", "told", "untold"),
    [
        (trusted_until(np.inf), {}, "Both runs agree with the references to the end", "visibly"),
        (trusted_until(3.5), {}, "The runs visibly leave the references", "Both"),
        (trusted_until(np.inf, 3.0), {}, "to τ = 3. There the reference ends", "to the end"),
        (trusted_until(np.nan, np.nan), {}, "No reference is known", "agree"),
        (trusted_until(np.inf), {"solver_rtol": 1e-2}, "No reference is known", "agree"),
        (trusted_until(np.inf), {"solver": "other"}, "No reference is known", "agree"),
    ],
)
def test_a_caption_says_no_more_of_a_reference_than_is_known(
    tmp_path, trust, attributes, told, untold
):
    results = norms_results(tmp_path, trust, **attributes)
    if "solver" in attributes:
        for size in ("small", "large"):
            run = results[f"trajectories/fig2_{size}"]
            results._paths[f"trajectories/fig2_{size}.other.nc"] = tmp_path
            results._read[f"trajectories/fig2_{size}.other"] = run
    said = caption(paper._norms(results, 2))
    assert told in said and untold not in said


@pytest.mark.parametrize(
    ("chaotic", "told", "untold"),
    [
        (("fig2_large",), "another solution of the same kind", "error of its solver"),
        ((), "error of its solver where the case is not chaotic (Ω", "of the same kind"),
    ],
)
def test_a_regular_run_that_leaves_its_reference_is_no_other_solution(
    tmp_path, chaotic, told, untold
):
    results = norms_results(tmp_path, trusted_until(3.5), chaotic=chaotic)
    said = plain(caption(paper._norms(results, 2)))
    assert told in said and untold not in said


@pytest.mark.parametrize(("scale", "shown"), [(1.0, "0.600 to 1.00"), (2.0, "1.20 to 2.00")])
def test_norms_are_read_from_their_datasets(tmp_path, scale, shown):
    results = norms_results(tmp_path, trusted_until(3.5), scale)
    figure = paper._norms(results, 2)
    small, large = figure["rows"]
    assert [str(cell) for cell in small[1:3]] == [shown, f"{0.6 * scale:#.3g}"]
    assert [str(cell) for cell in small[4:]] == ["Theorem 1", "0.5", "120"]
    assert large[3] == ("3.5", f"{paper.TRUST}.nc")
    assert len(figure["divergences"]) == 1 and shown.split()[0][:3] in figure["picture"].alt


def sweeps(right: list[float]) -> dict[str, xr.Dataset]:
    """Return the sweeps of Fig 5: a level one, and one whose maxima are given."""
    widths, names = [5, 10, 20, 40, 80, 160], ("fig5_left", "fig5_right")
    made = {}
    for name, omega, maxima in zip(names, (-4.0, 0.0), ([2.0] * 6, right), strict=True):
        values = np.stack([maxima, [2.0] * 6], axis=1)[:, None, :, None]
        dims = ("half_width", "quantity", "statistic", "window")
        coords = {"half_width": widths, "quantity": ["pair"], "statistic": ["max", "mean"]}
        made[f"sweeps/{name}"] = xr.Dataset(
            dict.fromkeys(("l2", "linf"), (dims, values)),
            {**coords, "window": ["[10, 50]"]},
            {"omega": omega, "initial": made_up.SMALL, "solver": "ode45"},
        )
    return made


def samples(mean: float) -> dict[str, xr.Dataset]:
    numbers = {"l2_mean": mean, "l2_deviation": 2.0, "swept_run": 7.0}
    numbers["deviations"] = (7.0 - mean) / 2.0
    unknown = {"swept_run": 8.0}  # longer chains have a run and no ensemble
    drawn = {
        name: (("sweep", "half_width"), [[value, unknown.get(name, np.nan)]])
        for name, value in numbers.items()
    }
    drawn |= {"swept_omega": ("sweep", [0.0]), "swept_initial": ("sweep", [made_up.SMALL])}
    coords = {"sweep": ["fig5_right"], "half_width": [160, 240]}
    members = xr.Dataset({"swept_members": ("sweep", [8])}, {"sweep": ["fig5_right"]})
    return {"checks/ensemble_runs": xr.Dataset(drawn, coords=coords), "checks/ensembles": members}


def swept_results(folder, right: list[float], mean: float) -> made_up.MadeUp:
    growth = made_up.lyapunov("fig4_small", cases={"fig4_small": (0.0, made_up.SMALL)})
    results = made_up.MadeUp(folder, {**sweeps(right), **samples(mean), "checks/lyapunov": growth})
    windows = {"case": "fig4_small", "drawn": {"max": [10, 50], "mean": [10, 50]}}
    results.settings = {"sweeps": dict.fromkeys(("fig5_left", "fig5_right"), windows)}
    return results


def plain(text) -> str:
    return str(text).replace("\N{NO-BREAK SPACE}", " ")


@pytest.mark.parametrize(
    ("values", "shape", "level"),
    [
        ([1.0, 2, 4, 7, 7, 7], "grows", "level from M = 40"),
        ([1, 2, 3, 4, 5, 7], "grows", "not level by the end"),
        ([2, 2, 9, 7, 3, 3], "rises to 9.00 at M = 20 and falls again", "not level by the end"),
        ([9, 8, 7, 7, 7, 7], "falls", "level from M = 20"),
        ([7, 7, 7, 7, 7, 7], "stays as it is", "level from M = 5"),
    ],
)
def test_the_way_of_a_sweep_is_found_from_its_numbers(tmp_path, values, shape, level):
    figure = paper._sweeps(swept_results(tmp_path, values, 10.0), 5)
    curve = figure["l2"][2]
    assert str(curve["shape"]) == shape and plain(curve["level"]) == level
    assert curve["by_text"] and curve["shape"].link == "sweeps/fig5_right.nc"
    assert len(figure["rows"]) == 8 and str(figure["widths"]) == "6"


@pytest.mark.parametrize(("mean", "off", "below"), [(10.0, "1.5", True), (5.0, "1", False)])
def test_a_chaotic_run_is_set_beside_its_ensemble(tmp_path, mean, off, below):
    (sample,) = paper._sweeps(swept_results(tmp_path, [1] * 6, mean), 5)["samples"]
    assert (str(sample["off"]), sample["below"], str(sample["runs"])) == (off, below, "8")
    assert str(sample["width"]) == "160" and sample["chaotic"]


def test_a_run_of_a_regular_sweep_is_no_sample_of_chaos(tmp_path):
    results = swept_results(tmp_path, [1] * 6, 10.0)
    results._read["checks/lyapunov"] = made_up.lyapunov()
    (sample,) = paper._sweeps(results, 5)["samples"]
    assert not sample["chaotic"]


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
    assert (
        shown["half"] and shown["still"] == 2 and str(shown["still_tau"]) == "1"
    )  # two of three sites move
    assert shown["bars"][0] == [0.0, 1.0, 0.0]


def test_a_chain_of_which_half_never_moves_shows_its_end(tmp_path):
    still = moving_chain().isel(component=[0])
    shown = motion.played(made_up.MadeUp(tmp_path, {"trajectories/a": still}), "trajectories/a")
    assert not shown["half"] and shown["still"] == 3


def test_the_ledger_is_shown_and_counted(tmp_path):
    rows = [
        made_up.claim("a", place="Section 5, Fig 5 left"),
        made_up.claim("b", "not reproduced", because="the l2 norm grows"),
        made_up.claim("c", place="Beyond the paper, Fig 5", origin="of this project"),
    ]
    results = made_up.MadeUp(
        tmp_path, {"checks/chart": xr.Dataset()}, **{"claims.json": made_up.ledger(*rows)}
    )
    shown = claims.gather(results)
    assert str(shown["total"]) == "3"
    (origin, number, counts), (_, own, _) = shown["counts"]
    assert str(own) == "1"
    assert (origin, str(number), shown["verdicts"]) == ("of the paper", "2", list(dict(counts)))
    assert [str(count) for _, count in counts] == ["1", "1"]
    assert shown["rows"][1]["because"] == "the ℓ² norm grows"
    assert shown["rows"][0]["measured"] == "largest rate = 0.25"
    assert shown["rows"][0]["criterion"] == "largest rate ≤ 0.001"
    assert shown["rows"][0]["data"][0].link == "checks/chart.nc"
    ledger = claims.Ledger(results)
    assert ledger.counts("Fig 5") == [("confirmed", 1)] and ledger.counts("Fig 6") == []


def test_numbers_of_the_ledger_link_to_what_decides_them(tmp_path):
    rows = [made_up.claim("a", measured={"x": 1.5, "y": "none"}), made_up.claim("b", measured={})]
    results = made_up.MadeUp(
        tmp_path, {"checks/chart": xr.Dataset()}, **{"claims.json": made_up.ledger(*rows)}
    )
    ledger = claims.Ledger(results)
    assert ledger.quote("a", "x") == ("1.5", "checks/chart.nc")
    assert np.isnan(ledger.value("a", "y")) and np.isnan(ledger.value("b", "x"))
    assert ledger.holds("a") and ledger.verdict("b") == "confirmed"


def breathers_results(folder, **attributes) -> made_up.MadeUp:
    """Return what the section says of breathers, with runs of the paper's data or of others."""
    runs = {
        f"trajectories/fig{which}_{size}": run_of(size, 1.0).assign_attrs(
            omega=omega, initial=made_up.LARGE if size == "large" else made_up.SMALL
        )
        for which, omega in ((2, 8.0), (3, -4.0), (4, 0.0))
        for size in ("small", "large")
    }
    runs["trajectories/fig2_large"].attrs.update(attributes)
    fate = xr.Dataset(
        {
            "fate": (("omega", "a0", "b0"), np.zeros((2, 2, 2), dtype=np.int8)),
            "area": (
                ("plane", "omega", "fate_name"), [[[0.25, 0.75, 0.0], [0.0, 0.25, 0.75]]]
            ),
            "case_fate": ("case", [1, 2]), "case_a0": ("case", [5.0, 5.0]),
            "case_b0": ("case", [1.0, 1.0]),
        },
        {"omega": [8.0, 0.0], "plane": ["amplitudes"], "case": ["fig2_large", "fig4_large"],
         "fate_name": ["disperses", "stays", "spreads"]},
    )  # fmt: skip
    periodic = xr.Dataset(
        {"least_power": (("instant", "omega", "family"), [[[40.0]], [[36.0]]])}, {"omega": [-4.0]}
    )
    shares = sensitivity(1.0, 0.9, 0.4, 0.15).assign_attrs(omega=-4.0)
    found = {"breathers/sensitivity": shares, "breathers/fates": fate}
    return made_up.MadeUp(folder, runs | found | {"breathers/periodic": periodic})


def beside(results: made_up.MadeUp, which: int) -> str:
    folders = [page.STUDIES, page.HERE / "templates"]
    loader = FileSystemLoader(folders)
    templates = Environment(loader=loader, trim_blocks=True, undefined=StrictUndefined)
    part = templates.get_template("paper/section.html.j2").module
    found = beside_breathers(results, which).get("breathers")
    return re.sub(r"<[^>]+>|\s+", " ", str(part.beside_breathers(found)))


@pytest.mark.parametrize(
    ("which", "words"),
    [
        (2, ["75 % stay", "figure among them", "0 % spread"]),
        (3, ["P of 36 or more", "have 1", "100 % spread", "15 % do", "3 amplitudes"]),
        (4, ["25 % stay", "75 % spread, the large data of the figure among them"]),
        (5, ["P of 36 or more", "75 % spread"]),
        (6, ["75 % stay", "15 % do"]),
    ],
)
def test_each_figure_says_what_breathers_change(tmp_path, which, words):
    said = " ".join(beside(breathers_results(tmp_path), which).split())
    for one in words:
        assert one in said, said


def test_of_other_data_it_is_not_said_that_they_are_on_the_map(tmp_path):
    other = breathers_results(tmp_path, initial='{"0": [5.0, "1j"], "3": [1.0, 0.0]}')
    assert "among them" not in beside(other, 2)


def test_a_run_of_another_study_of_breathers_says_nothing(tmp_path):
    results = breathers_results(tmp_path)
    results.differs = {"breathers.fates.points": "14 and not 4"}
    assert beside(results, 6).strip() == ""
