"""The report's part on breathers: families, growth by the drive, sensitivity, and fates."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import xarray as xr

from pendula.ledger.section import Ledger
from pendula.report.results import Figure, Results, Section, Table
from pendula.report.words import number, percent, span, symbols, told

from .fate_contents import TIMES
from .nearest import HALF_PERIODS, NEAR

STEADY, PERIODIC = "breathers/steady", "breathers/periodic"
GROWTH, SENSITIVITY, MAP = "breathers/growth", "breathers/sensitivity", "breathers/fates"


def gather(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return the families, what runs from nearby initial conditions do, and fates on one pair."""
    return {
        "steady": _steady(results),
        "families": _families(results),
        "collisions": Table(
            "Collisions of Floquet multipliers, at which a periodic breather becomes unstable",
            ["Ω", "family", "λ", "perturbation", "multiplier over half a period",
             "Krein signatures"], list(_collisions(results)),
        ),
        "breathers": _law(results),
        "shares": _shares_that_spread(results),
        "sensitivity": results.figure("sensitivity", told(
            "Share of runs that spread, with confidence intervals, and the largest norm of runs "
            "from {scanned} initial amplitudes. Of these, from A₀ = {range}, {spread} spread.",
            scanned=results.quote(SENSITIVITY, results[SENSITIVITY].sizes["initial"]),
            range=results.say(SENSITIVITY, span(results[SENSITIVITY]["initial"].values)),
            spread=results.quote(SENSITIVITY, int(results[SENSITIVITY]["spread"].sum())),
        )),
        "What becomes of initial conditions on one pair": _fates(results),
    }  # fmt: skip


def _steady(results: Results) -> Table:
    """Return how fast the worst perturbation of each family grows, and the Omegas it changes at."""
    data = results[STEADY]
    omegas = data["omega"].values
    born = dict(zip(data["born_family"].values, data["pitchfork"].values, strict=True))
    stable = {name: data["stable_below"].sel(stable_family=name).values[-1]
              for name in data["stable_family"].values}  # fmt: skip
    rows = []
    for name in data["family"].values:
        rates = data["growth"].sel(family=name).values
        cells = ["none" if np.isnan(r) else number(float(r)) if r else "stable" for r in rates]
        cells += [number(float(one[name]), 6) if name in one else "" for one in (born, stable)]
        rows.append([symbols(str(name)), *(results.say(STEADY, cell) for cell in cells)])
    return Table(
        "Steady breathers, with constant amplitudes in the rotating frame: growth rate of the "
        "worst perturbation per unit of τ (none: no such state was found)",
        ["family", *(f"Ω = {number(omega)}" for omega in omegas), "branches off at Ω",
         "stable below Ω"], rows,
    )  # fmt: skip


def _families(results: Results) -> Table:
    """Return P and stability of each family of periodic breathers."""
    data, rows = results[PERIODIC], []
    for omega, family in ((o, f) for o in data["omega"].values for f in data["family"].values):
        one = data.sel(omega=omega, family=family)
        frequency, power = one["frequency"].values, one["power"].sum("component", skipna=False)
        found = np.flatnonzero(np.isfinite(power.values))
        cells = ["none"] * 4
        if found.size:
            unstable = frequency[one["growth"].values > 0]
            lowest = found[frequency[found].argmin()]
            values = (float(power[lowest]), *map(float, one["least_power"].values))
            said = f"λ of {span(unstable)}" if unstable.size else "no frequency"
            cells = [*(results.quote(PERIODIC, one) for one in values), results.say(PERIODIC, said)]
        rows.append([number(float(omega)), symbols(str(family)), *cells])
    return Table(
        f"Periodic breathers at frequencies λ from {span(data['frequency'].values)}, above the "
        f"highest linear wave at {span(data['highest_wave'].values)}; P is the sum of |A|² + |B|² "
        "over the chain when A and B are real. Least values are over all frequencies",
        ["Ω", "family", "P at the lowest λ", "least P", "least P within a period", "unstable at"],
        rows,
    )  # fmt: skip


def _collisions(results: Results) -> Iterator[list]:
    """Yield a row for each collision: where it is, what meets, and with which signatures."""
    data = results[PERIODIC]
    met = data["collision_frequency"].transpose("omega", "family", "frequency", "parity")
    for at in np.argwhere(np.isfinite(met.values)):
        one = data.isel(dict(zip(met.dims, at, strict=True)))
        real, imaginary = one["collision_multiplier"].values
        signs = ("+" if sign > 0 else "−" for sign in one["collision_signature"].values)
        value = number(real, 4) + (f" ± {number(imaginary, 4)} i" if imaginary else "")
        yield [
            number(float(one["omega"])),
            symbols(str(one["family"].item())),
            results.quote(PERIODIC, float(one["collision_frequency"]), 5),
            str(one["parity"].item()),
            results.say(PERIODIC, value),
            results.say(PERIODIC, " and ".join(signs)),
        ]


def _law(results: Results) -> Figure:
    """Return the figure of the families, with what the drive adds to a localised motion."""
    growth = results[GROWTH]
    return results.figure("breathers", told(
        "P of periodic breathers against their frequency; a hollow mark is an unstable one, stars "
        "and crosses mark collisions of Floquet multipliers. Last panel: a localised motion whose "
        "frequency λ = {start} lies among the linear waves gains P from the drive until λ has left "
        "the band; by the law of weak drives it gains {law}, and γ is {drives}.",
        start=results.quote(GROWTH, growth.attrs["start_frequency"]),
        law=results.quote(GROWTH, float(growth["predicted_gain"].max())),
        drives=results.say(GROWTH, span(growth["gamma"].values, 2)),
    ))  # fmt: skip


def _shares_that_spread(results: Results) -> Table:
    """Return the share of runs that spread, by the size of the perturbation."""
    data = results[SENSITIVITY]
    ends = ("", "_low", "_high")
    return Table(
        f"Runs that spread over the chain at Ω = {number(float(data.attrs['omega']))}, of "
        f"{number(float(data.attrs['members']))} with random relative changes of the initial "
        "condition, with confidence interval; snakemake sensitivity makes many more",
        ["relative change", "share that spreads", "lower end", "upper end"],
        [[number(float(size)),
          *(results.say(SENSITIVITY, percent(float(data[f"share{end}"].sel(size=size))))
            for end in ends)]
         for size in data["size"].values],
    )  # fmt: skip


AXES = {"amplitudes": ("a0", "b0"), "phases": ("turned_a0", "phase")}
PLANES = {"amplitudes": "real A₀ and B₀", "phases": "A₀ and the phase of B₀"}


def _fates(results: Results) -> dict[str, Any]:
    """Return shares of area, what is periodic of that which stays, and runs done differently."""
    data = results[MAP]
    names = [str(name) for name in data["fate_name"].values]
    fates, omegas = data["checked_fate"], [float(omega) for omega in data["omega"].values]
    planes = [str(plane) for plane in data["plane"].values]
    changed = [[one, results.quote(MAP, int((fates.sel(conditions=one) != fates[0]).sum()))]
               for one in map(str, data["conditions"].values[1:])]  # fmt: skip
    end = number(float(data.attrs["end_time"]))
    return {
        "shares": Table(
            f"Fates by τ = {end}, as shares of the area of initial conditions, with confidence "
            "intervals; where neighbours on the grid have the same fate, the area between counts "
            "as known. A run stays if the three pairs at the "
            "centre hold most of P and moves if three others do; else it disperses if P is no "
            "larger than linear waves make it, and spreads if it is larger",
            ["Ω", "initial conditions", "how many", *names],
            [_shares(results, plane, omega) for plane in planes for omega in omegas],
        ),
        "periodic": Table(
            f"Which motions that stay are periodic, followed over {number(HALF_PERIODS)} half "
            "periods, and their distance from the breathers of the same frequency",
            ["Ω", "periodic", f"of these within {number(NEAR)}", "median distance"],
            [row for omega in omegas if (row := _periodic(results, omega))],
        ),
        "fates": results.figure("fates", told(
            "What becomes of initial conditions (A₀, B₀) on one pair, above by real amplitudes, "
            "below by A₀ and the phase of B₀. A circle marks the initial conditions of Figs 2 to "
            "4, in the colour of their own fate. The maps are those of <code>snakemake "
            "fates</code>, if they are of this configuration; {agreed} of {common} common initial "
            "conditions have the same fate in the coarse maps of this run.",
            common=results.quote(MAP, int(data["common"].sum()), 6),
            agreed=results.quote(MAP, int(data["agreed"].sum()), 6),
        )),
        "changed": Table(
            f"Of {fates[0].size} initial conditions run again, how many have another fate; the "
            f"longest runs end at τ = {number(TIMES * float(data.attrs['end_time']))}",
            ["run with", "another fate"], changed,
        ),
    }  # fmt: skip


def _shares(results: Results, plane: str, omega: float) -> list:
    """Return a row: how many initial conditions there are, and the share of each fate."""
    data = results[MAP].sel(plane=plane, omega=omega)
    count = int(np.prod([data.sizes[axis] for axis in AXES[plane]]))
    fates = (data.isel(fate_name=i) for i in range(data.sizes["fate_name"]))
    shares = (results.say(MAP, _share_with_limits(one)) for one in fates)
    return [number(omega), PLANES[plane], results.quote(MAP, count, 6), *shares]


def _share_with_limits(one: xr.Dataset) -> str:
    """Return the share of an area and its interval in per cent, such as 14.2 % (14 to 14.4)."""
    names = ("area", "area_low", "area_high")
    value, low, high = (number(100.0 * float(one[name])) for name in names)
    return f"{value} % ({low} to {high})"


def _periodic(results: Results, omega: float) -> list:
    """Return a row on what stays on the first map, empty if nothing does.

    A = B is left out as in the shares: it has families of its own.
    """
    data = results[MAP]
    here = data[["fate", "periodic", "family_distance"]].sel(omega=omega)
    here = here.where(here["a0"] != here["b0"])
    stays = here["fate"] == list(data["fate_name"].values).index("stays")
    known = here["family_distance"].values[np.isfinite(here["family_distance"].values)]
    if not stays.any():
        return []
    return [
        number(omega),
        results.say(MAP, percent(float((here["periodic"] == 1).sum() / stays.sum()))),
        results.say(MAP, percent(float((known <= NEAR).mean()))) if known.size else "unknown",
        results.quote(MAP, float(np.median(known)), 2) if known.size else "unknown",
    ]


SECTIONS = (Section("breathers", "Breathers, and which initial conditions spread", gather),)
