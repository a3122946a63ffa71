"""The rows of the claims ledger: every sentence of the paper that numbers can decide.

A row says where the sentence stands, what it says, which datasets decide it (paths below
`results/` without their ending) and which function.
"""

from collections.abc import Callable
from typing import NamedTuple

from . import claims_model as model
from . import claims_norms as norms
from . import claims_solvers as solvers
from . import claims_stability as stability
from . import claims_sweeps as sweeps
from .verdicts import Finding


class Claim(NamedTuple):
    """One row before it is decided."""

    name: str
    place: str
    says: str
    needs: tuple[str, ...]
    decide: Callable[..., Finding]


def checks(*names: str) -> tuple[str, ...]:
    """Return the datasets of checks."""
    return tuple(f"checks/{name}" for name in names)


def runs(*names: str) -> tuple[str, ...]:
    """Return the datasets of trajectories."""
    return tuple(f"trajectories/{name}" for name in names)


def swept(*names: str) -> tuple[str, ...]:
    """Return the datasets of sweeps."""
    return tuple(f"sweeps/{name}" for name in names)


SMALL = ("fig2_small", "fig3_small", "fig4_small")
LARGE = ("fig2_large", "fig3_large", "fig4_large")
FIG_2, FIG_4 = runs("fig2_small", "fig2_large"), runs("fig4_small", "fig4_large")
SWEEPS = ("fig5_left", "fig5_right", "fig6_left", "fig6_right")
BOUNDS = checks("samples", "worst")
SECOND = ".crank_nicolson"

CLAIMS = (
    Claim(
        "hamiltonian",
        "Section 2, (7) and (8)",
        "The equations are the Hamiltonian system of the energy H.",
        checks("gradient"),
        model.hamiltonian,
    ),
    Claim(
        "conserved",
        "Section 2, (8)",
        "The energy H is conserved.",
        checks("conservation"),
        model.conserved,
    ),
    Claim(
        "no_gauge",
        "Abstract; Section 2",
        "The equations have no gauge symmetry.",
        checks("conservation"),
        model.no_gauge,
    ),
    Claim(
        "one_integral",
        "Introduction",
        "The energy is the only integral of motion.",
        checks("conservation"),
        model.one_integral,
    ),
    Claim(
        "pt_form",
        "Section 2, (9) and (10)",
        "In the variables u, v the equations take the form (10).",
        checks("pt_form"),
        model.pt_form,
    ),
    Claim(
        "pt_energy",
        "Section 2, after (11)",
        "The PT-symmetric form is Hamiltonian with a modified energy.",
        checks("pt_form"),
        model.pt_energy,
    ),
    Claim(
        "pt_symmetry",
        "Section 2, (11)",
        "The form (10) is invariant under the action of P and T.",
        checks("pt_form"),
        model.pt_symmetry,
    ),
    Claim(
        "exchange",
        "Section 2, before (7)",
        "The equations are invariant under the exchange of A and B.",
        checks("symmetries"),
        model.exchange,
    ),
    Claim(
        "synchronised",
        "Section 2, (5) and (6)",
        "A = B is an invariant reduction on which the drive has no effect.",
        checks("symmetries", "opposite"),
        model.synchronised,
    ),
    Claim(
        "slow_time",
        "Section 2, after (4)",
        "The amplitudes in the expansion move with tau = mu^2 t / 2.",
        checks("expansion"),
        model.slow_time,
    ),
    Claim(
        "printed_time",
        "Section 2, (3)",
        "The amplitudes in the expansion are functions of mu^2 t.",
        checks("expansion"),
        model.printed_time,
    ),
    Claim(
        "drive_sign",
        "Section 2, (2) and (4)",
        "The drive D = 2 gamma mu^2 cos 2 omega t gives gamma (conj B - conj A).",
        checks("expansion"),
        model.drive_sign,
    ),
    Claim(
        "dispersion",
        "Section 3, (15)",
        "The characteristic equation factorises into the dispersion relation.",
        checks("dispersion"),
        stability.dispersion,
    ),
    Claim(
        "stable_below",
        "Lemma 1",
        "Zero is linearly stable for |gamma| < gamma_0.",
        checks("chart"),
        stability.stable_below,
    ),
    Claim(
        "unstable_above",
        "Lemma 1",
        "Zero is linearly unstable for |gamma| > gamma_0.",
        checks("chart"),
        stability.unstable_above,
    ),
    Claim(
        "unstable_band",
        "Lemma 1",
        "Zero is linearly unstable for Omega in [0, 4 epsilon] and any gamma but 0.",
        checks("chart", "windows", "measured_windows"),
        stability.unstable_band,
    ),
    Claim(
        "threshold_growth",
        "Proof of Lemma 1",
        "At |gamma| = gamma_0 perturbations grow polynomially.",
        checks("threshold"),
        stability.threshold_growth,
    ),
    Claim(
        "growth_bound",
        "Lemma 2, (19)",
        "The squared l2 norm grows at most as exp(4 |gamma tau|).",
        (*checks("growth"), *runs(*SMALL, *LARGE)),
        stability.growth_bound,
    ),
    Claim(
        "balance",
        "Proof of Lemma 2",
        "The l2 norm obeys the balance equation.",
        checks("balance"),
        stability.balance,
    ),
    Claim(
        "inequalities",
        "Section 4, (17), (18), (21), (22), (25), (27)",
        "The inequalities behind the theorems hold.",
        checks("inequalities"),
        stability.inequalities,
    ),
    Claim(
        "theorem_1",
        "Theorem 1",
        "For Omega > 2 gamma + 4 epsilon the l2 norm is bounded for all data.",
        BOUNDS,
        stability.theorem_1,
    ),
    Claim(
        "theorem_2",
        "Theorem 2",
        "For Omega < -2 gamma the l2 norm is bounded for small data.",
        BOUNDS,
        stability.theorem_2,
    ),
    Claim(
        "positive_depth",
        "Proof of Theorem 2",
        "-H > 0 is constant in time.",
        checks("negative_depth"),
        stability.positive_depth,
    ),
    Claim(
        "theorem_3",
        "Theorem 3",
        "On N sites the l2 norm is bounded for all parameters and data.",
        BOUNDS,
        stability.theorem_3,
    ),
    Claim(
        "theorem_3_proof",
        "Proof of Theorem 3",
        "The quadratic part of H is at least -(|Omega| + gamma + 4 epsilon) P.",
        checks("theorem_3_constant"),
        stability.theorem_3_proof,
    ),
    Claim(
        "sharp_bounds",
        "Section 6",
        "The bounds on the l2 norms are sharp.",
        checks("worst"),
        stability.sharp_bounds,
    ),
    Claim(
        "energy_small",
        "Section 5",
        "H is conserved to the order of 1e-6 for the smaller data.",
        runs(*SMALL),
        solvers.energy_small,
    ),
    Claim(
        "energy_large",
        "Section 5",
        "H is conserved to the order of 1e-4 for the larger data.",
        runs(*LARGE),
        solvers.energy_large,
    ),
    Claim(
        "fig2_bounded",
        "Section 5, Fig 2",
        "The simulation confirms the global bound of Theorem 1 at Omega = 8.",
        FIG_2,
        norms.bounded_by_theorem_1,
    ),
    Claim(
        "fig2_centre",
        "Section 5, Fig 2 upper",
        "The oscillation of the central pendulum decreases.",
        runs("fig2_small"),
        norms.centre_decreases,
    ),
    Claim(
        "fig2_exchange",
        "Section 5, Fig 2 upper",
        "The l2 norm oscillates between A and B.",
        runs("fig2_small"),
        norms.modes_exchange,
    ),
    Claim(
        "fig2_maxima",
        "Section 5, Fig 2 upper",
        "The l-infinity norms of A and B are comparable and change little.",
        runs("fig2_small"),
        norms.maxima_comparable,
    ),
    Claim(
        "fig2_separate",
        "Section 5, Fig 2 lower",
        "The motion of A is effectively separated from that of B.",
        runs("fig2_large"),
        norms.modes_separate,
    ),
    Claim(
        "fig2_alone",
        "Section 5, Fig 2 lower",
        "The central pendulum does not excite large oscillations of others.",
        runs("fig2_large"),
        norms.centre_alone,
    ),
    Claim(
        "fig3_alike",
        "Section 5, Fig 3 upper",
        "For small data Omega = -4 shows no drastic difference to Omega = 8.",
        runs("fig2_small", "fig3_small"),
        norms.like_omega_8,
    ),
    Claim(
        "fig3_mix",
        "Section 5, Fig 3 lower",
        "A and B mix up.",
        runs("fig3_large"),
        norms.modes_mix,
    ),
    Claim(
        "fig3_excited",
        "Section 5, Fig 3 lower",
        "The central pendulum excites large oscillations of others and l2 grows.",
        runs("fig3_large"),
        norms.others_excited,
    ),
    Claim(
        "fig3_maximum",
        "Section 5, Fig 3 lower",
        "The l-infinity norm stays at the level of the initial data.",
        runs("fig3_large"),
        norms.maximum_stays,
    ),
    Claim(
        "fig4_unstable",
        "Section 5, Fig 4",
        "Zero is linearly unstable at Omega = 0.",
        FIG_4,
        norms.unstable_at_zero,
    ),
    Claim(
        "fig4_settles",
        "Section 5, Fig 4",
        "Growth stabilises at a certain level of the l-infinity norm.",
        FIG_4,
        norms.maximum_settles,
    ),
    Claim(
        "fig4_l2_larger",
        "Section 5, Fig 4",
        "The l2 norm is significantly larger than the l-infinity norm.",
        FIG_4,
        norms.sum_exceeds_maximum,
    ),
    Claim(
        "fig4_many",
        "Section 5, Fig 4",
        "Many pendula oscillate with amplitudes comparable to the central one's.",
        FIG_4,
        norms.many_in_motion,
    ),
    Claim(
        "fig4_alike",
        "Section 5, Fig 4",
        "There are no visible differences between the upper and lower panels.",
        FIG_4,
        norms.panels_alike,
    ),
    Claim(
        "equilibrium",
        "Abstract; Section 6",
        "Excitation spreads until every pendulum oscillates at a finite amplitude.",
        runs("fig4_small"),
        norms.equilibrium,
    ),
    Claim(
        "finite_bound",
        "Section 5, before Fig 5",
        "By Theorem 3 the solution in the finite chain stays bounded.",
        runs(*SMALL, *LARGE),
        norms.finite_bound,
    ),
    Claim(
        "fig5_grows",
        "Section 5, Fig 5 right",
        "The maximal l2 norm grows nearly monotonically with M at Omega = 0.",
        swept("fig5_right"),
        sweeps.l2_grows_with_m,
    ),
    Claim(
        "fig5_conjecture",
        "Section 5, Fig 5 right",
        "This confirms growth on the unbounded lattice as time goes to infinity.",
        swept("fig5_right"),
        sweeps.conjecture,
    ),
    Claim(
        "fig5_maximum",
        "Section 5, Fig 5 right",
        "The l-infinity norm saturates to the same level whatever M.",
        swept("fig5_right"),
        sweeps.maximum_independent_of_m,
    ),
    Claim(
        "fig5_decreases",
        "Section 5, Fig 5 left",
        "At Omega = -4 the l2 norm decreases in M towards a level.",
        swept("fig5_left"),
        sweeps.l2_decreases_with_m,
    ),
    Claim(
        "fig5_theorem_2",
        "Section 5, Fig 5 left",
        "The absence of growth agrees with Theorem 2.",
        (*runs("fig3_small"), *swept("fig5_left")),
        sweeps.agrees_with_theorem_2,
    ),
    Claim(
        "fig5_caption",
        "Fig 5, caption",
        "The norms shown are averages over [10, 50].",
        swept("fig5_left"),
        sweeps.caption_of_fig_5,
    ),
    Claim(
        "fig5_not_shown",
        "Section 5, Fig 5",
        "A similar dependence (not shown) exists for Omega = 8.",
        checks("not_shown"),
        sweeps.not_shown,
    ),
    Claim(
        "fig6_constant",
        "Section 5, Fig 6 left",
        "At Omega = 8 the maximal l2 norm does not change with N.",
        swept("fig6_left"),
        sweeps.independent_of_m,
    ),
    Claim(
        "fig6_theorem_1",
        "Section 5, Fig 6 left",
        "This agrees with Theorem 1.",
        (*runs("fig2_large"), *swept("fig6_left")),
        sweeps.bounded_by_theorem_1,
    ),
    Claim(
        "fig6_grows",
        "Section 5, Fig 6 right",
        "At Omega = -4, large data, the maximal l2 norm grows with M.",
        swept("fig6_right"),
        sweeps.large_data_grow_with_m,
    ),
    Claim(
        "fig6_diverges",
        "Section 5, Fig 6 right",
        "It apparently diverges as N goes to infinity.",
        swept("fig6_right"),
        sweeps.large_data_diverge,
    ),
    Claim(
        "fig6_not_technical",
        "Section 5, Fig 6 right",
        "That Theorem 2 is limited to small data is not a technical shortfall.",
        (*runs("fig3_large"), *swept("fig6_right")),
        sweeps.not_technical,
    ),
    Claim(
        "fig6_caption",
        "Fig 6, caption",
        "The norms shown are averages over [10, 40].",
        swept("fig6_left", "fig6_right"),
        sweeps.caption_of_fig_6,
    ),
    Claim(
        "unbounded_in_time",
        "Introduction",
        "The l2 norm diverges in the unbounded chain as time goes to infinity.",
        swept("fig5_right", "fig6_right"),
        sweeps.unbounded_in_time,
    ),
    Claim(
        "second_solver",
        "Section 5, end",
        "Figs 2 to 4 come out of the second solver without significant differences.",
        runs(*SMALL, *LARGE, *(name + SECOND for name in (*SMALL, *LARGE))),
        solvers.solvers_agree,
    ),
    Claim(
        "second_solver_sweeps",
        "Section 5, end",
        "So do Figs 5 and 6.",
        swept(*SWEEPS, *(name + SECOND for name in SWEEPS)),
        solvers.sweeps_agree,
    ),
)
