"""The ledger: complete, computed, and turned over by other numbers."""

import json

import numpy as np
import pytest
import xarray as xr
from made_up import paper_sweeps, paper_trajectories
from made_up_unbounded import spread, unbounded_runs
from pendula.ledger.claim import all_claims, decide, evaluate, feed, needed, passes
from pendula.ledger.criterion import Verdict
from pendula.studies.theory.checks import CHECKS
from pendula.studies.theory.settings import WRONG, WRONG_FOLDER

HOLDS = {Verdict.CONFIRMED, Verdict.CAVEAT}
CLAIMS = all_claims()
CLAIM = {claim.name: claim for claim in CLAIMS}


@pytest.fixture(scope="module")
def sources(checked):
    wrong = [f"{WRONG_FOLDER}{name}" for name in WRONG]
    checks = {f"checks/{name}": xr.Dataset.from_dict(checked(name)) for name in [*CHECKS, *wrong]}
    return checks | paper_trajectories() | paper_sweeps() | unbounded_runs()


def made(sources):
    """Return the claims whose datasets are made up here."""
    return [claim for claim in CLAIMS if set(claim.needs) <= set(sources)]


def test_rows_are_many_and_named_once(sources):
    assert len(made(sources)) >= 30
    assert len(CLAIM) == len(CLAIMS)
    assert {name for claim in CLAIMS for name in claim.needs} <= set(needed())


def test_rows_are_ready_for_json_and_verdicts_from_the_enumeration(sources):
    rows = json.loads(json.dumps(evaluate(sources), allow_nan=False))
    assert [row["name"] for row in rows] == [claim.name for claim in CLAIMS]
    known = {claim.name for claim in made(sources)}
    for row in rows:
        assert row["verdict"] in set(Verdict)
        assert bool(row["measured"]) == (row["name"] in known), row["name"]
        assert (row["verdict"] == Verdict.CONFIRMED) == (row["because"] == ""), row


def test_without_datasets_nothing_is_decided():
    rows = evaluate({})
    assert {row["verdict"] for row in rows} == {Verdict.UNDECIDED}
    assert all("was not made" in row["because"] for row in rows)


def test_short_runs_and_sweeps_do_not_decide(sources):
    short = sources["trajectories/fig2_small"].sel(tau=slice(0, 15))
    finding = decide(CLAIM["fig2_excites"], sources | {"trajectories/fig2_small": short})
    assert finding.verdict == Verdict.UNDECIDED and "tau = 15" in finding.because
    brief = sources["unbounded/fig4_small"].sel(tau=slice(0, 50))
    finding = decide(CLAIM["unbounded_in_time"], sources | {"unbounded/fig4_small": brief})
    assert finding.verdict == Verdict.UNDECIDED and "tau = 50" in finding.because
    narrow = sources["sweeps/fig5_left"].sel(window=["[10, 40]"])
    finding = decide(CLAIM["fig5_decreases"], sources | {"sweeps/fig5_left": narrow})
    assert finding.verdict == Verdict.UNDECIDED and "[10, 50]" in finding.because


def scaled(name, factor, **selection):
    """Return a change of a dataset: one variable times a factor, at some coordinates or all."""

    def change(ds):
        ds = ds.copy(deep=True)
        if selection:
            ds[name].loc[selection] = ds[name].loc[selection] * factor
        else:
            ds[name] = ds[name] * factor + (factor if factor > 1 else 0)
        return ds

    return change


def after(name, factor, start, component="A"):
    return scaled(name, factor, component=component, tau=slice(start, None))


def replaced(name, values):
    def change(ds):
        ds = ds.copy(deep=True)
        ds[name][:] = np.reshape(values, (-1, *[1] * (ds[name].ndim - 1)))
        return ds

    return change


def after_start(name, factor):
    return lambda run: run.assign({name: run[name].where(run["tau"] == 0.0, factor * run[name])})


def centre_times(factor):
    return lambda run: run.assign(
        state=run["state"] * np.where(np.arange(run.sizes["site"]) < 8, factor, 1.0)
    )


def one_member_times(factor):
    return lambda run: run.assign(
        l2=run["l2"] * np.where(np.arange(run.sizes["member"]) == 1, factor, 1.0)[:, None]
    )


def keeping_attributes(change):
    def changed(ds):
        result = change(ds)
        for name in ds.data_vars:
            result[name].attrs = ds[name].attrs
        return result

    return changed


def window_map_without_level(data):
    return data.assign(l2=data["l2"] * data["half_width"] ** 0.2)


INEQUALITIES = "checks/inequalities"
FLIPS = {
    "hamiltonian": ("checks/gradient", scaled("gradient_error", 1e6)),
    "no_gauge": ("checks/conservation", scaled("gauge_defect", 0.0)),
    "pt_form": ("checks/pt_form", scaled("trajectory", 10.0)),
    "exchange": ("checks/symmetries", scaled("exchange", 2.0)),
    "synchronised": ("checks/symmetries", scaled("scalar", 2.0)),
    "pendula_synchronised": ("checks/pendula_synchrony", scaled("drive_effect", 2.0)),
    "inherited": ("checks/inherited_energy", scaled("energy_order", 0.5)),
    "resonance": ("checks/resonance", scaled("driven_rate", 0.5)),
    "slow_time": ("checks/expansion", scaled("order", 0.3)),
    "drive_sign": ("checks/expansion", scaled("order", 0.3)),
    "dispersion": ("checks/dispersion", scaled("eigenvalue_error", 2.0)),
    "sharp_threshold": ("checks/sharp_threshold", scaled("threshold_error", 2.0)),
    "unstable_waves": ("checks/unstable_waves", scaled("waves_nearer", 2.0)),
    "stable_below": ("checks/chart", scaled("measured", 2.0)),
    "unstable_band": ("checks/chart", scaled("infinite_rate", 0.0)),
    "threshold_growth": ("checks/threshold", scaled("wave_error", 2.0)),
    "growth_bound": ("trajectories/fig3_large", scaled("l2", 100.0, tau=slice(20, None))),
    "balance": ("checks/balance", scaled("integrated", 2.0)),
    "local_existence": ("checks/picard", scaled("picard_error_backwards", 2.0)),
    "uniqueness": ("checks/picard", scaled("limits_apart_backwards", 2.0)),
    "continuous_dependence": ("checks/dependence", scaled("stretch_over_bound", 2.0)),
    "sign_of_gamma": ("checks/conservation", scaled("sign_defect", 2.0)),
    "norm_inequalities": (INEQUALITIES, scaled("left_over_right", 2.0, inequality="(22)")),
    "energy_bounds": (INEQUALITIES, scaled("bound_excess", -1.0, bound="(25)")),
    "bound_grows": ("checks/chain_growth", scaled("power_exponent_low", 0.1)),
    "energy_not_useful": ("checks/energy_shell", scaled("shell_exponent", 0.1)),
    "theorem_1": ("checks/samples", scaled("worst_sample", 2.0)),
    "theorem_2": ("checks/worst", scaled("worst", 5.0)),
    "positive_depth": ("checks/negative_depth", scaled("most_energy", -1.0)),
    "theorem_3": ("checks/samples", scaled("worst_sample", 2.0)),
    "sharp_theorems": ("checks/sharpness", scaled("reached", 0.5, form="theorem_2")),
    "fig2_bounded": ("trajectories/fig2_large", scaled("l2", 5.0)),
    "fig2_excites": ("trajectories/fig2_small", after("linf", 4.0, 20)),
    "fig2_exchange": ("trajectories/fig2_small", replaced("l2", 1.0)),
    "fig2_maxima": ("trajectories/fig2_small", after("linf", 4.0, 30)),
    "fig2_separate": ("trajectories/fig2_large", after("l2", 5.0, 20, "B")),
    "fig3_alike": ("trajectories/fig3_small", after("l2", 5.0, 20)),
    "fig4_unstable": ("trajectories/fig4_small", scaled("l2", 0.04, tau=slice(0.1, None))),
    "finite_bound": ("trajectories/fig4_small", scaled("l2", 5.0)),
    "energy_small": ("trajectories/fig2_small", scaled("energy", 2.0, tau=slice(5, None))),
    "energy_large": ("trajectories/fig2_large", scaled("energy", 2.0, tau=slice(5, None))),
    "fig5_decreases": ("sweeps/fig5_left", replaced("l2", 1.0 + 0.1 * np.arange(8.0))),
    "fig5_theorem_2": ("sweeps/fig5_left", replaced("l2", 5.0 + np.zeros(8))),
    "fig5_not_shown": ("checks/not_shown", replaced("l2", np.arange(1.0, 10.0))),
    "fig6_constant": ("sweeps/fig6_left", replaced("l2", 5.0 + np.arange(8.0))),
    "unbounded_in_time": ("unbounded/fig4_small", lambda _: spread(0.2)),
    "unbounded_band": ("unbounded/omegas", lambda _: spread([0.5, 0.0, 0.5], variants=3)),
    "unbounded_front": ("unbounded/omegas", scaled("predicted_speed", 0.9)),
    "unbounded_equilibrium": ("unbounded/thermal", scaled("power", 0.5)),
    "unbounded_large_maximum": ("unbounded/fig3_large", after_start("linf", 3.0)),
    "unbounded_many": ("unbounded/fig4_small", centre_times(10.0)),
    "unbounded_determined": ("unbounded/fig2_large", one_member_times(1.5)),
    "unbounded_large": ("unbounded/fig3_large", lambda _: spread(0.1)),
    "unbounded_small": ("unbounded/fig3_small", lambda _: spread(0.1)),
    "unbounded_stable": ("unbounded/fig2_large", lambda _: spread(0.1)),
    "unbounded_window": ("unbounded/map_fig5_right", window_map_without_level),
}


PARTS = [
    ("no_gauge", "checks/pt_form", scaled("gauge_defect", 0.0)),
    ("hamiltonian", "checks/conservation", scaled("energy_drift", 10.0)),
    ("pt_form", "checks/pt_form", scaled("energy_gradient", 10.0)),
    ("pt_form", "checks/pt_form", scaled("pt", 10.0)),
    ("synchronised", "checks/conservation", scaled("gauge_defect_alike", 2.0)),
    ("dispersion", "checks/dispersion", scaled("first_growth", 2.0)),
    ("dispersion", "checks/dispersion", scaled("contradictions", 2.0)),
    ("stable_below", "checks/chart", scaled("measured", 0.0)),
    *(
        ("norm_inequalities", INEQUALITIES, scaled("left_over_right", 2.0, inequality=one))
        for one in ("(17)", "(18)", "(27)")
    ),
    *(
        ("energy_bounds", INEQUALITIES, scaled("bound_excess", -1.0, bound=one))
        for one in ("(21)", "size")
    ),
    ("sharp_theorems", "checks/sharpness", scaled("reached", 0.5, form="theorem_1")),
    ("sharp_theorems", "checks/sharpness", scaled("reached", 0.5, form="theorem_3")),
    ("fig2_excites", "trajectories/fig2_small", scaled("l2", 0.2, tau=slice(20, None))),
    ("fig2_separate", "trajectories/fig2_large", after("linf", 6.0, 20, "B")),
    ("fig2_bounded", "sweeps/fig6_left", replaced("l2", 20.0 + np.zeros(8))),
]
"""What each part of a sentence of several parts falls by, beside FLIPS."""


@pytest.mark.parametrize(
    ("name", "source", "change"), [*((name, *flip) for name, flip in FLIPS.items()), *PARTS]
)
def test_claim_holds_and_flips_when_its_numbers_change(name, source, change, sources):
    before = decide(CLAIM[name], sources)
    assert before.verdict in {*HOLDS, Verdict.UNDECIDED}, before
    damaged = sources | {source: keeping_attributes(change)(sources[source])}
    assert decide(CLAIM[name], damaged).verdict == Verdict.NOT_REPRODUCED


def of_the_theory(sources):
    """Return pairs of a claim of this study and a control whose datasets are all here."""
    own = [claim for claim in made(sources) if ".theory." in claim.decide.__module__]
    pairs = [(claim, control) for claim in own for control in claim.controls]
    assert len(pairs) >= 35
    return pairs


def test_every_wrong_statement_is_refused_and_every_right_one_confirmed(sources):
    for claim, control in of_the_theory(sources):
        finding = feed(claim, control, sources)
        assert finding.verdict != Verdict.UNDECIDED, (claim.name, control.says)
        assert passes(control, finding), (claim.name, control.says, finding)


def test_every_criterion_refuses_some_number_and_what_is_none(sources):
    found = [decide(claim, sources) for claim in made(sources)]
    judged = [finding for finding in found if finding.criterion is not None]
    assert len(judged) >= len(found) - 3  # what no number can settle has no criterion
    for measured, criterion, *_ in judged:
        assert str(criterion)
        wrongs = criterion.refuted_by()
        assert {name for wrong in wrongs for name in wrong} >= set(criterion.names)
        for wrong in wrongs:
            assert not criterion.holds({**measured, **wrong}), (str(criterion), wrong)
        for name in criterion.names:
            assert not criterion.holds({**measured, name: np.nan}), (str(criterion), name)


def test_a_claim_says_what_the_paper_says_and_its_function_does_not_say_it_again():
    for claim in CLAIMS:
        assert claim.says.endswith(".") and claim.place
        assert claim.says not in (claim.decide.__doc__ or "")


def test_a_claim_of_a_misprint_holds_when_the_misprint_is_mended(sources):
    mended = sources["checks/theorem_3_constant"].copy(deep=True)
    mended["printed"] = mended["corrected"]
    assert decide(CLAIM["theorem_3_proof"], sources).verdict == Verdict.NOT_REPRODUCED
    changed = sources | {"checks/theorem_3_constant": mended}
    assert decide(CLAIM["theorem_3_proof"], changed).verdict == Verdict.CONFIRMED


def test_every_claim_can_fall_or_says_that_no_number_can_settle_it():
    """A claim falls here by other numbers, or in every run by a wrong case that it is fed."""
    always_open = {"one_integral", "fig6_caption"}
    mended = {"theorem_3_proof", "bootstrap", "sharp_theorem_2_ball"}
    controlled = {claim.name for claim in CLAIMS if claim.controls}
    assert set(FLIPS) <= set(CLAIM)
    assert set(CLAIM) == set(FLIPS) | controlled | always_open | mended


@pytest.mark.parametrize(
    ("second", "error", "verdict"),
    [
        (0.2, 0.01, Verdict.CAVEAT),
        (0.0, 0.01, Verdict.NOT_REPRODUCED),
        (0.0, 0.5, Verdict.UNDECIDED),  # limits wider than what lies between two exponents
        (0.2, 0.5, Verdict.UNDECIDED),
    ],
)
def test_a_second_integral_is_seen_where_exponents_are_resolved(second, error, verdict):
    sizes = np.array([0.0, second, 0.5, 0.7, 0.9, 1.2, 1.5])
    values = np.concatenate([sizes, -sizes])
    along = ("spectrum_case", "spectrum_half_width", "index")
    spectra = xr.Dataset(
        {
            "exponents": (along, values.reshape(1, 1, -1)),
            "exponents_error": (along, np.full((1, 1, values.size), error)),
        },
        {"spectrum_case": ["fig4_small"], "spectrum_half_width": [3]},
    )
    assert CLAIM["one_integral"].decide(spectra).verdict == verdict


def test_region_word_changes_with_the_data(sources):
    finding = decide(CLAIM["fig5_theorem_2"], sources)
    assert finding.verdict == Verdict.CAVEAT and "bonds" in finding.because
    tiny = sources["trajectories/fig3_small"].copy(deep=True)
    tiny["l2"] *= 0.3
    tiny["energy"] *= 0.09
    inside = sources | {"trajectories/fig3_small": tiny}
    inside["sweeps/fig5_left"] = replaced("l2", 0.3 + np.zeros(8))(sources["sweeps/fig5_left"])
    assert decide(CLAIM["fig5_theorem_2"], inside).verdict == Verdict.CONFIRMED
