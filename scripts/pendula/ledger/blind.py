"""Which general distortions may leave a claim confirmed, and why: they make no wrong case of it.

A claim that a distortion confirms without a reason here has a function that does not look at what
the sentence is on. A reason that its claim does not need is out of date. A test holds both.
"""

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
        "small data do so at Omega = -4 as at 8, as the paper says of Fig 3": """
            fig2_excites fig2_exchange fig2_maxima stable_oscillations""",
        "it holds of the other case too": """
            ensemble_fig3_maximum ensemble_fig5_maximum ensemble_fig6_grows
            ensemble_fig6_not_technical ensemble_fig6_time steady_unstable ends_near_stable
            unbounded_maximum unbounded_large_maximum""",
        "that dataset is told beside what decides": """
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
        "extremes, means, shares and fitted laws know no order": """
            hamiltonian no_gauge synchronised inherited slow_time drive_sign dispersion
            unstable_band sharp_threshold threshold_growth continuous_dependence growth_bound
            sign_of_gamma theorem_1 theorem_2 theorem_3 bound_grows energy_not_useful
            finite_bound fig2_bounded stable_oscillations fig3_only_small fig5_theorem_2
            second_solver ensemble_fig3_grows ensemble_fig3_excites ensemble_fig3_mixes
            ensemble_fig3_maximum ensemble_fig4_settles ensemble_fig4_many ensemble_equilibrium
            even_bands_wider steady_unstable stable_on_any_chain ends_near_stable
            detuning_decides unbounded_equilibrium unbounded_slope breathers_exist
            breathers_stable_or_not ensemble_fig4_alike""",
        "it is so all the time, or at every M, or at every end": """
            fig2_exchange fig2_separate fig3_alike fig6_constant ensemble_fig5_maximum
            ensemble_fig6_not_technical ensemble_fig6_time unbounded_small unbounded_stable
            unbounded_large_maximum unbounded_determined same_sea expansion_order
            next_order_of_the_expansion""",
        "the drive's ratio 2 is in the middle": "resonance",
        "backwards the runs end with their data": "pendula_stay_below_the_top unbounded_maximum",
        "that dataset is told beside what decides, or for a largest number":
            "unbounded_in_time unbounded_large horizon_logarithmic",
    },
    SIZE: {
        "zeros, signs and counts have no size": """
            unstable_band sign_of_gamma exchange synchronised pendula_synchronised
            periodic_stable stable_on_any_chain ends_near_stable fig3_only_small uniqueness""",
        "a ratio": """
            growth_bound fig2_excites stable_oscillations fig4_unstable fig5_decreases
            fig5_not_shown ensemble_fig3_excites ensemble_fig3_maximum ensemble_fig4_many
            unbounded_determined grows_as_floquet_says lemma_1_is_the_limit fig2_exchange
            fig2_maxima fig2_separate fig6_constant ensemble_fig3_grows ensemble_fig4_settles
            ensemble_equilibrium unbounded_band unbounded_small unbounded_stable
            unbounded_large_maximum odd_as_even grows_by_drive pendula_norms
            rates_of_the_pendula ensemble_fig5_grows ensemble_fig6_grows fig5_caption""",
        "the largest of several runs decides, or that dataset for yes or no alone": """
            finite_bound second_solver stable_is_regular even_bands_wider""",
        "that dataset is told beside what decides": """
            unbounded_in_time unbounded_large unbounded_slope""",
    },
}  # fmt: skip
"""By kind of distortion and reason the claims, by name."""


def reason_of(kind: str, claim: str) -> str:
    """Return why a kind of distortion may leave a claim confirmed; empty where it may not."""
    reasons = BLIND.get(kind, {}).items()
    return "; ".join(why for why, claims in reasons if claim in claims.split())
