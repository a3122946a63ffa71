"""Long names of the variables in the replication's datasets, and the program that writes them.

Everything in the paper is dimensionless. Time is the slow time tau, so that a rate is "per unit of
tau".
"""

from latticode.datasets.registry import MADE_BY, NAMES, WAYS

from pendula import __version__

NAMES.update(
    {
        # coordinates
        "tau": "slow time",
        "snapshot_tau": "slow time of the snapshots",
        "component": "pendulum of each pair",
        "half_width": "half-width M of the chain of 2M + 1 pairs",
        "quantity": "pendulum of each pair, or both",
        "reading": "reading of the paper",
        "curve_omega": "detuning Omega, on a finer grid",
        "panel": "panel of the figure",
        "initial_size": "size of the initial data, small or large",
        "course": "course of time, forward or backward",
        # the problem
        "omega": "detuning Omega",
        "gamma": "strength of the drive, gamma",
        "epsilon": "coupling of neighbours, epsilon",
        "mu": "small parameter mu",
        "initial": "initial {site: [A, B]}",
        "sites": "number of sites N",
        # the solution
        "energy": "conserved energy H of equation (8)",
        "modulus": "modulus of the amplitude on a site",
        "amplitude": "amplitude on a site",
        # of the studies
        "family": "family",
        "power": "power P",
        "growth": "largest rate of growth of a perturbation",
        "error": "error",
        "region": "region",
        "gamma_0": "gamma_0 of",
        "final": "amplitude at the end time",
        "state": "amplitude at the snapshots",
    }
)
WAYS["make"] = "run snakemake"
MADE_BY.update(version=__version__, history=f"computed by pendula {__version__}")
