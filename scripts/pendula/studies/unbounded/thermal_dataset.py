"""Thermal states without energy as a dataset."""

import numpy as np

from pendula.datasets.netcdf import Variable

from .sea import LENGTH, distribution, spectrum
from .thermal import Thermal

HIGHEST_MODULUS, CELLS = 12.0, 80


def thermal_variables(omegas: list[float], found: list[Thermal]) -> dict[str, Variable]:
    """Return the statistics of the thermal states without energy, one for each Omega."""
    amplitudes = [thermal.states[:, 0::2] + 1j * thermal.states[:, 1::2] for thermal in found]
    moduli = np.linspace(0.0, HIGHEST_MODULUS, CELLS + 1)
    energies = [thermal.energies.mean() for thermal in found]
    powers = [t.at_zero_energy((t.states**2).sum(axis=1).mean(axis=1)) for t in found]
    return {
        "omega": Variable(("omega",), np.array(omegas, float), "detuning Omega"),
        "beta": Variable(("omega",), [t.beta for t in found], "inverse temperature"),
        "energy": Variable(("omega",), energies, "energy per site of the samples"),
        "power": Variable(("omega",), powers, "mean of |A_n|^2 + |B_n|^2 at zero energy"),
        "modulus": Variable(
            ("modulus",), 0.5 * (moduli[1:] + moduli[:-1]), "modulus |A_n| or |B_n|"
        ),
        "density": Variable(
            ("omega", "modulus"),
            [distribution(np.abs(z), moduli) for z in amplitudes],
            "density of the moduli",
        ),
        "wave_number": Variable(
            ("wave",), 2.0 * np.pi * np.arange(LENGTH) / LENGTH, "wave number", "rad"
        ),
        "spectrum": Variable(
            ("omega", "wave"), [spectrum(z.ravel(), LENGTH) for z in amplitudes], "mean |A(k)|^2"
        ),
    }
