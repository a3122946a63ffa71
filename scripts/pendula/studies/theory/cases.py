"""The paper's own cases and sweeps beside the bounds of Lemma 2 and Theorems 1 to 3."""

import numpy as np

from pendula.datasets.checks import table, variable
from pendula.measures.readings import constants, growth_margin, powers
from pendula.problem import Constants, Problem, on_sites, place, read_initial
from pendula.simulation.simulate import simulate

from .bounds import (
    best_bound,
    proven_region,
    theorem_1_bound,
    theorem_2_bound,
    theorem_2_constants,
    theorem_3_bound,
    widened_bound,
)
from .runs import TIGHT, squared_norm, total_energy

NUMBERS = {
    "energy": "H at the start",
    "start": "P at the start, delta",
    "observed": "largest P",
    "theorem_1": "C of Theorem 1",
    "theorem_2": "bound on P from the barrier of (25)",
    "widened": "the same with the bonds kept",
    "theorem_3": "C_N of Theorem 3",
    "best": "smallest bound that holds",
    "delta_0": "radius of Theorem 2",
    "c_0": "constant C_0 of Theorem 2",
    "from_start": "largest P over its bound (19)",
    "backwards": "the same seen from the end",
    "steepest": "steepest log P over 4 gamma",
}


def case_numbers(trajectory) -> tuple[dict[str, float], str]:
    """Return the numbers of one trajectory named in NUMBERS, and the theorem that covers it."""
    parameters, boundary = constants(trajectory), str(trajectory.attrs["boundary"])
    sites = 2 * int(trajectory.attrs["half_width"]) + 1
    energy, power = float(trajectory["energy"][0]), powers(trajectory)
    start = float(power[0])
    widened = widened_bound(energy, start, parameters) if boundary == "dirichlet" else np.inf
    delta_0, c_0 = theorem_2_constants(parameters)
    numbers = {
        "energy": energy,
        "start": start,
        "observed": power.max(),
        "theorem_1": theorem_1_bound(energy, parameters),
        "theorem_2": theorem_2_bound(energy, start, parameters),
        "widened": widened,
        "theorem_3": theorem_3_bound(energy, sites, parameters),
        "best": best_bound(energy, start, sites, parameters, boundary),
        "delta_0": delta_0,
        "c_0": c_0,
    }
    tau, l2 = trajectory["tau"].values, trajectory["l2"].values
    numbers |= growth_margin(tau, l2, parameters[1])
    region = proven_region(energy, start, parameters, boundary)
    return {name: float(value) for name, value in numbers.items()}, region


def labels(datasets, dims: tuple) -> dict:
    """Return the detuning and the initial data of each dataset, by which a figure names it."""
    return {
        "omega": variable([float(ds.attrs["omega"]) for ds in datasets], dims, "detuning Omega"),
        "initial": variable(
            [str(ds.attrs["initial"]) for ds in datasets], dims, "initial {site: [A, B]}"
        ),
    }


def check_cases(trajectories: dict) -> dict:
    """Set each of the paper's trajectories (by the name of its case) beside its bounds."""
    found = [case_numbers(trajectory) for trajectory in trajectories.values()]
    columns = {name: [numbers[name] for numbers, _ in found] for name in NUMBERS}
    dims = ("case",)
    ratio = np.array(columns["observed"]) / np.array(columns["best"])
    described = {name: variable(columns[name], dims, text) for name, text in NUMBERS.items()}
    return table(
        "The paper's cases beside the bounds of its theorems",
        {"case": list(trajectories)},
        region=variable([region for _, region in found], dims, "theorem that covers the case"),
        ratio=variable(ratio, dims, "largest P over its smallest bound", tolerance=1.0),
        margin=variable(columns["steepest"], dims, "growth over that of (19)", tolerance=1 + 1e-6),
        **labels(trajectories.values(), dims),
        **described,
    )


def check_sweeps(sweeps: dict) -> dict:
    """Set the largest P of each swept chain beside its bounds, that of Theorem 3 growing with N."""
    half_widths = np.unique(np.concatenate([s["half_width"].values for s in sweeps.values()]))
    shape, dims = (len(sweeps), len(half_widths)), ("sweep", "half_width")
    observed, finite, best = (np.full(shape, np.nan) for _ in range(3))
    for i, sweep in enumerate(sweeps.values()):
        parameters, boundary = constants(sweep), str(sweep.attrs["boundary"])
        peaks = sweep["l2"].sel(quantity="pair", statistic="max").max("window").values ** 2
        for half_width, peak in zip(sweep["half_width"].values, peaks, strict=True):
            j, sites = np.searchsorted(half_widths, half_width), 2 * int(half_width) + 1
            amplitudes = place(on_sites(read_initial(sweep.attrs["initial"])), int(half_width))
            energy = total_energy(parameters, boundary, amplitudes)
            start = float(np.sum(np.abs(amplitudes) ** 2))
            observed[i, j] = peak
            finite[i, j] = theorem_3_bound(energy, sites, parameters)
            best[i, j] = best_bound(energy, start, sites, parameters, boundary)
    return table(
        "The paper's sweeps beside the bounds of its theorems",
        {"sweep": list(sweeps), "half_width": half_widths},
        observed=variable(observed, dims, "largest P in the windows"),
        theorem_3=variable(finite, dims, "C_N of Theorem 3"),
        best=variable(best, dims, "smallest bound that holds"),
        **labels(sweeps.values(), ("sweep",)),
        excess=variable(
            np.nanmax(observed / best), (), "largest P over its smallest bound", tolerance=1.0
        ),
    )


def check_not_shown(
    half_widths, window=(10.0, 50.0), omega: float = 8.0, solver: dict | None = None
) -> dict:
    """Run the sweep at Omega = 8, small data, that the paper mentions and does not show."""
    peaks = []
    for half_width in half_widths:
        trajectory = simulate(
            Problem(
                constants=Constants(epsilon=1.0, gamma=1.0, omega=omega),
                half_width=int(half_width),
                boundary="dirichlet",
                initial=on_sites({0: (1.0, 0.1)}),
                end_time=window[1],
                output_step=0.025,
                solver=solver or TIGHT | {"rtol": 1e-9},
            )
        )
        inside = trajectory.tau >= window[0]
        peaks.append(np.sqrt(squared_norm(trajectory.l2)[inside].max()))
    return table(
        f"Largest l2 on [{window[0]:g}, {window[1]:g}] at Omega = {omega:g}, small data",
        {"half_width": np.asarray(half_widths)},
        l2=variable(peaks, ("half_width",), "largest l2 norm of the pair"),
    )
