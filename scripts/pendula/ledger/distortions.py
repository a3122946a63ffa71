"""General distortions of datasets, fed to every claim to find what its function does not look at.

The controls of a claim are wrong cases for that claim alone. Here every dataset of every claim is
distorted in each of these ways, and what the claim's function finds goes into
results/controls.json. A function that still confirms its claim does not look at what the sentence
is on, unless BLIND gives a reason. Tests require a reason for each, and no other reasons.
"""

import math
import warnings
from collections.abc import Callable, Iterable, Mapping
from typing import NamedTuple

import numpy as np
import xarray as xr

from pendula.numerics.draws import normal

from .claim import Claim
from .criterion import Finding, Verdict, undecided
from .verdicts import confirmed, decide

OMEGA, EXCHANGE, ORDER, SIZE = "another Omega", "A and B exchanged", "another order", "other sizes"
"""The kinds of distortions that may have a reason: what is missing has none."""

BLIND = {
    OMEGA: {
        "it is on every Omega, and the numbers of one stay together": """
            stable_below unstable_band sharp_threshold threshold_growth growth_bound
            finite_bound second_solver unbounded_band unbounded_equilibrium unbounded_front
            odd_as_even even_bands_wider stable_on_any_chain opposite_signatures_collide
            grows_as_floquet_says lemma_1_is_the_limit rates_of_the_pendula expansion_order
            next_order_of_the_expansion remainder_bounded""",
        "the small case does so at Omega = -4 as at 8, as the paper says of Fig 3": """
            fig2_excites fig2_exchange fig2_maxima stable_oscillations""",
        "it holds for the other case too": """
            ensemble_fig3_maximum ensemble_fig5_maximum ensemble_fig6_grows
            ensemble_fig6_not_technical ensemble_fig6_time steady_unstable ends_near_stable
            unbounded_maximum unbounded_large_maximum""",
        "this dataset is reported and does not decide": """
            unbounded_in_time unbounded_large unbounded_slope""",
    },
    EXCHANGE: {
        "its numbers are those of the pair, or alike in A and B": """
            growth_bound finite_bound fig2_bounded fig2_exchange fig2_maxima stable_oscillations
            fig3_alike fig3_only_small fig4_unstable second_solver fig5_decreases fig5_theorem_2
            fig6_constant ensemble_fig3_grows ensemble_fig3_excites ensemble_fig3_mixes
            ensemble_fig3_maximum ensemble_fig4_settles ensemble_fig4_many ensemble_equilibrium
            ensemble_fig5_grows ensemble_fig5_maximum ensemble_fig6_grows
            ensemble_fig6_not_technical ensemble_fig6_time even_bands_wider steady_unstable
            periodic_stable stable_on_any_chain opposite_signatures_collide
            grows_as_floquet_says data_below_breathers ends_near_stable pendula_norms
            breathers_exist breathers_stable_or_not fig5_caption ensemble_fig4_alike""",
    },
    ORDER: {
        "extremes, means, shares and fits do not depend on the order": """
            hamiltonian no_gauge synchronised inherited slow_time drive_sign dispersion
            unstable_band sharp_threshold threshold_growth continuous_dependence growth_bound
            sign_of_gamma theorem_1 theorem_2 theorem_3 bound_grows energy_not_useful
            finite_bound fig2_bounded stable_oscillations fig3_only_small fig5_theorem_2
            second_solver ensemble_fig3_grows ensemble_fig3_excites ensemble_fig3_mixes
            ensemble_fig3_maximum ensemble_fig4_settles ensemble_fig4_many ensemble_equilibrium
            even_bands_wider steady_unstable stable_on_any_chain ends_near_stable
            detuning_decides unbounded_equilibrium unbounded_slope breathers_exist
            breathers_stable_or_not ensemble_fig4_alike""",
        "it holds at all times, at every M or at every end": """
            fig2_exchange fig2_separate fig3_alike fig6_constant ensemble_fig5_maximum
            ensemble_fig6_not_technical ensemble_fig6_time unbounded_small unbounded_stable
            unbounded_large_maximum unbounded_determined same_sea expansion_order
            next_order_of_the_expansion""",
        "the resonant ratio is in the middle": "resonance",
        "reversed runs end with their initial condition": "pendula_stay_below_the_top",
        "this dataset is reported and does not decide, or for a largest number":
            "unbounded_in_time unbounded_large horizon_logarithmic",
    },
    SIZE: {
        "zeros, signs and counts do not change": """
            unstable_band sign_of_gamma exchange synchronised pendula_synchronised
            periodic_stable stable_on_any_chain ends_near_stable fig3_only_small uniqueness""",
        "ratios do not change": """
            growth_bound fig2_excites stable_oscillations fig4_unstable fig5_decreases
            fig5_not_shown ensemble_fig3_excites ensemble_fig3_maximum ensemble_fig4_many
            unbounded_determined grows_as_floquet_says lemma_1_is_the_limit fig2_exchange
            fig2_maxima fig2_separate fig6_constant ensemble_fig3_grows ensemble_fig4_settles
            ensemble_equilibrium unbounded_band unbounded_small unbounded_stable
            unbounded_large_maximum odd_as_even grows_by_drive pendula_norms
            rates_of_the_pendula ensemble_fig5_grows ensemble_fig6_grows fig5_caption""",
        "the largest of several runs decides, or only a sign in this dataset": """
            finite_bound second_solver stable_is_regular even_bands_wider""",
        "this dataset is reported and does not decide": """
            unbounded_in_time unbounded_large unbounded_slope""",
    },
}  # fmt: skip
"""By kind of distortion and reason the claims, by name."""

Change = Callable[[str, Mapping[str, xr.Dataset]], xr.Dataset | None]
"""What makes the distorted dataset from the name of one and all at hand; None: it cannot."""

MISSING = "missing"
OMEGAS = {"case": 2, "spectrum_case": 1, "sweep": 1, "omega": 1, "growth_omega": 1, "variant": 1}
"""Coordinates along which Omega changes, and after how many places: each case has two sizes."""
COMPONENTS = ("component", "quantity")
SEED, NOISE = 2017, 0.1
ROUNDING = 1e-2
"""Of a ratio that a factor leaves as it is, far less than any distortion moves."""


class Distortion(NamedTuple):
    """A way to distort any dataset, and its kind: those of one kind share their reasons."""

    says: str
    change: Change
    kind: str


def another_omega(name: str, sources: Mapping[str, xr.Dataset]) -> xr.Dataset | None:
    """Return a dataset with the numbers of other cases, or another case's dataset in its place."""
    dataset = sources[name]
    places = {along: by for along, by in OMEGAS.items() if dataset.sizes.get(along, 1) > by}
    if places:
        return dataset.roll(places, roll_coords=False)
    folder, _, file = name.rpartition("/")
    about, solver = dataset.attrs, file.partition(".")[2]
    others = [
        found
        for other, found in sorted(sources.items())
        if other.rpartition("/")[0] == folder
        and other.rpartition("/")[2].partition(".")[2] == solver
        and set(dataset) <= set(found)
        and found.attrs.get("omega", about.get("omega")) != about.get("omega")
    ]
    # from the initial condition of the same size, where there is one
    return min(
        others, key=lambda one: one.attrs.get("initial") != about.get("initial"), default=None
    )


def exchanged(name: str, sources: Mapping[str, xr.Dataset]) -> xr.Dataset | None:
    """Return a dataset with A and B exchanged."""
    dataset, other = sources[name], {"A": "B", "B": "A"}
    found = [along for along in COMPONENTS if along in dataset.indexes]
    return dataset.assign_coords(
        {along: [other.get(str(one), str(one)) for one in dataset[along].values] for along in found}
    ) if found else None  # fmt: skip


def backwards(name: str, sources: Mapping[str, xr.Dataset]) -> xr.Dataset | None:
    """Return a dataset in reverse order along its coordinates of numbers, which keep their own."""
    dataset = sources[name]
    found = {
        along: dataset[along]
        for along, index in dataset.indexes.items()
        if along not in OMEGAS and index.dtype.kind in "fiu" and len(index) > 1
    }
    turned = dataset.isel(dict.fromkeys(found, slice(None, None, -1)))
    return turned.assign_coords(found) if found else None


def two_alone(name: str, sources: Mapping[str, xr.Dataset]) -> xr.Dataset | None:
    """Return the first and the last of a dataset along all that it has more than two of."""
    dataset = sources[name]
    many = [along for along, size in dataset.sizes.items() if size > 2 and along not in OMEGAS]
    numbered = [one for one in many if one not in dataset or dataset[one].dtype.kind in "fiu"]
    return dataset.isel({along: [0, -1] for along in numbered}) if numbered else None


def of_numbers(change: Callable[[np.ndarray], np.ndarray]) -> Change:
    """Return the distortion that changes every variable that is made of numbers."""

    def changed(name: str, sources: Mapping[str, xr.Dataset]) -> xr.Dataset:
        dataset = sources[name]
        variables = {each: dataset.variables[each] for each in dataset}  # which need no alignment
        return dataset.assign(
            {
                each: one.copy(data=change(one.values.astype(float)))
                for each, one in variables.items()
                if one.dtype.kind in "fiu"
            }
        )

    return changed


def half_unknown(values: np.ndarray) -> np.ndarray:
    """Return every other number as unknown, and a single one too."""
    flat = values.flatten()
    flat[1 if flat.size > 1 else 0 :: 2] = np.nan
    return flat.reshape(values.shape)


def noisy(values: np.ndarray) -> np.ndarray:
    """Return numbers with relative noise, the same for all arrays of one size."""
    drawn = normal(np.random.default_rng(SEED), values.shape)
    return values * (1.0 + NOISE * drawn)


DISTORTIONS = (
    Distortion("another Omega", another_omega, OMEGA),
    Distortion("A and B exchanged", exchanged, EXCHANGE),
    Distortion("in reverse order", backwards, ORDER),
    Distortion("half unknown", of_numbers(half_unknown), MISSING),
    Distortion("two samples alone", two_alone, MISSING),
    Distortion("scaled by 1.3", of_numbers(lambda values: 1.3 * values), SIZE),
    Distortion("scaled by 0.7", of_numbers(lambda values: 0.7 * values), SIZE),
    Distortion("noise of 10 %", of_numbers(noisy), SIZE),
)


class Said(NamedTuple):
    """By which distorted datasets the function of a claim came to which finding."""

    refused: list[str]
    undecided: list[str]
    within: list[str]
    """Confirmed, since numbers that a distortion of size moved still keep their criterion."""
    blind: list[str]
    """Confirmed by the same numbers, or although a distortion is none of size."""

    def __str__(self) -> str:
        words = (("rejected", self.refused), ("not decided", self.undecided))
        counts = [f"{word} {len(names)}" for word, names in words if names]
        counts += [f"confirmed within its limits {len(self.within)}"] if self.within else []
        return ", ".join([*counts, *(f"confirmed by {name}" for name in self.blind)])


def distorted(claims: Iterable[Claim], sources: Mapping) -> dict[tuple[str, Distortion], Said]:
    """Return what the functions said by (name of the claim, distortion).

    Each dataset of a claim is distorted by itself, while the others are right.
    """
    claims = [claim for claim in claims if set(claim.needs) <= set(sources)]
    names = dict.fromkeys(name for claim in claims for name in claim.needs)
    right = {claim.name: decide(claim, sources) for claim in claims}
    told = {}
    for distortion in DISTORTIONS:
        wrong = {name: distortion.change(name, sources) for name in names}
        for claim in claims:
            said = Said([], [], [], [])
            for name in claim.needs:
                if wrong[name] is not None:
                    found = _decided(claim, {**sources, name: wrong[name]})
                    _place(found, right[claim.name], distortion, said).append(name)
            if any(said):
                told[claim.name, distortion] = said
    return told


def _decided(claim: Claim, sources: Mapping) -> Finding:
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        try:
            return decide(claim, sources)
        except (ArithmeticError, LookupError, ValueError) as error:
            return undecided({}, f"it cannot be read: {error}")


def _place(found: Finding, right: Finding, distortion: Distortion, said: Said) -> list[str]:
    """Return the list of `said` to which a finding belongs."""
    if not confirmed(found):
        return said.undecided if found.verdict == Verdict.UNDECIDED else said.refused
    judged = found.criterion.names if found.criterion else ()
    pairs = [(found.measured[name], right.measured.get(name, np.nan)) for name in judged]
    moved = any(not math.isclose(*pair, rel_tol=ROUNDING) for pair in pairs)
    return said.within if distortion.kind == SIZE and moved else said.blind


def in_words(told: Mapping[tuple[str, Distortion], Said]) -> list[dict]:
    """Return a row for each claim, as results/controls.json has it."""
    by_claim: dict[str, dict] = {}
    for (claim, distortion), said in told.items():
        reasons = BLIND.get(distortion.kind, {}).items() if said.blind else ()
        why = "; ".join(reason for reason, claims in reasons if claim in claims.split())
        row = by_claim.setdefault(claim, {"claim": claim, "fed": "general distortions"})
        row[distortion.says] = f"{said}: {why}" if why else str(said)
    return list(by_claim.values())
