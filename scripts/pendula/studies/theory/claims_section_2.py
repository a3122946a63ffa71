"""Section 2: what the paper says of the equations, their symmetries and their derivation."""

from pendula.ledger.row import checks, claim
from pendula.ledger.verdicts import Finding, judge, number, undecided, within_tolerance

# ASSUME: an order counts as three if it is nearer to three than to another whole number; a
# symmetry is missing if it is missed by more than one part in a thousand.
NEAR, MISSED = 0.5, 1e-3


@claim(
    "hamiltonian",
    "Section 2, (7) and (8)",
    "The equations are the Hamiltonian system of the energy H.",
    checks("gradient"),
)
def hamiltonian(gradient) -> Finding:
    """(7), (8): the right-hand side is the gradient of the energy, for each kind of ends."""
    return within_tolerance(gradient, "error")


@claim(
    "conserved",
    "Section 2, (8)",
    "The energy H is conserved.",
    checks("conservation"),
)
def conserved(conservation) -> Finding:
    """(8): H is constant along the flow."""
    return within_tolerance(conservation, "energy_drift")


@claim(
    "no_gauge",
    "Abstract; Section 2",
    "The equations have no gauge symmetry.",
    checks("conservation"),
)
def no_gauge(conservation) -> Finding:
    """The equations are not gauge-invariant."""
    defect = float(conservation["gauge_defect"].max())
    return judge({"gauge_defect": defect}, "gauge_defect > 1e-3", defect > MISSED)


@claim(
    "one_integral",
    "Introduction",
    "The energy is the only integral of motion.",
    checks("conservation"),
)
def one_integral(conservation) -> Finding:
    """The energy is the only integral of motion."""
    measured = {"l2_change": conservation["l2_change"].max()}
    return undecided(
        measured, "numbers show that the l2 norm is not conserved, not that nothing else is"
    )


@claim(
    "pt_form",
    "Section 2, (9) and (10)",
    "In the variables u, v the equations take the form (10).",
    checks("pt_form"),
)
def pt_form(pt) -> Finding:
    """(9), (10): the equivalent form."""
    return within_tolerance(pt, "rates", "trajectory")


@claim(
    "pt_energy",
    "Section 2, after (11)",
    "The PT-symmetric form is Hamiltonian with a modified energy.",
    checks("pt_form"),
)
def pt_energy(pt) -> Finding:
    """The PT form is Hamiltonian with a modified energy: H / 8, with u and v crosswise."""
    return within_tolerance(pt, "energy_gradient")


@claim(
    "pt_symmetry",
    "Section 2, (11)",
    "The form (10) is invariant under the action of P and T.",
    checks("pt_form"),
)
def pt_symmetry(pt) -> Finding:
    """(11): invariance under P and T, which holds for their product."""
    measured = {name: pt[name].max() for name in ("pt", "p_alone", "t_alone")}
    alone = min(measured["p_alone"], measured["t_alone"])
    caveat = ""
    if alone > 1e-6:
        caveat = "P and T together are a symmetry; either alone misses by 2 gamma max(|u|, |v|)"
    limit = pt["pt"].attrs["tolerance"]
    return judge(measured, f"pt <= {limit:.1g}", measured["pt"] <= limit, caveat)


@claim(
    "exchange",
    "Section 2, before (7)",
    "The equations are invariant under the exchange of A and B.",
    checks("symmetries"),
)
def exchange(symmetries) -> Finding:
    """The equations do not change under A <-> B."""
    return within_tolerance(symmetries, "exchange")


@claim(
    "synchronised",
    "Section 2, (5) and (6)",
    "A = B is an invariant reduction on which the drive has no effect.",
    checks("symmetries", "opposite"),
)
def synchronised(symmetries, opposite) -> Finding:
    """(5): A = B reduces (4) to the scalar dNLS, on which the drive has no effect."""
    finding = within_tolerance(symmetries, "synchrony", "norm_drift", "scalar")
    departure = number(opposite, "departure")
    return finding._replace(measured=finding.measured | {"opposite_departure": departure})


@claim(
    "slow_time",
    "Section 2, after (4)",
    "The amplitudes in the expansion move with tau = mu^2 t / 2.",
    checks("expansion"),
)
def slow_time(expansion) -> Finding:
    """(4): the amplitudes move with tau = mu^2 t / 2."""
    order = number(expansion, "order", reading="mu^2 t / 2")
    measured = {"order": order, "smallest_error": expansion["error"].values[-1, 0]}
    return judge(measured, "2.5 <= order in mu <= 3.5", abs(order - 3.0) <= NEAR)


@claim(
    "printed_time",
    "Section 2, (3)",
    "The amplitudes in the expansion are functions of mu^2 t.",
    checks("expansion"),
)
def printed_time(expansion) -> Finding:
    """(3): the amplitudes are written as functions of mu^2 t."""
    order = number(expansion, "order", reading="mu^2 t")
    measured = {"order": order, "smallest_error": expansion["error"].values[-1, 1]}
    fails = f"read so, the error falls only as mu^{order:.1f}, not as mu^3"
    return judge(measured, "2.5 <= order in mu <= 3.5", abs(order - 3.0) <= NEAR, fails=fails)


@claim(
    "drive_sign",
    "Section 2, (2) and (4)",
    "The drive D = 2 gamma mu^2 cos 2 omega t gives gamma (conj B - conj A).",
    checks("expansion"),
)
def drive_sign(expansion) -> Finding:
    """(2): D = 2 gamma mu^2 cos 2 omega t leads to + gamma in (4)."""
    right = number(expansion, "order", reading="mu^2 t / 2")
    wrong = number(expansion, "order", reading="mu^2 t / 2, opposite drive")
    measured = {"order": right, "order_opposite": wrong}
    return judge(measured, "order > 2.5 for this sign alone", right > 3.0 - NEAR > wrong)
