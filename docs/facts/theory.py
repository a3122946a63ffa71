"""Facts on Lemma 1 and Theorems 1 to 3."""

from pendula.report.words import number, percent, span

from .baseline import Baseline


def theory(baseline: Baseline) -> dict:
    """Return what the checks of Lemma 1 and of Theorems 1 to 3 found."""
    charts = [baseline[f"checks/{name}"]["measured"] for name in ("chart", "short_chart")]
    sharp, threshold = baseline["checks/sharpness"], baseline["checks/threshold"]
    slow = threshold["spreading_exponent"].mean("omega").isel(decay=1)
    reached = sharp["reached"].isel(sites=-1)
    bootstrap = baseline["checks/bootstrap"]
    printed, gap = baseline["checks/theorem_3_constant"], baseline["checks/theorem_2_case"]
    measured = {row["name"]: row["measured"] for row in baseline.claims()}
    cases = baseline["checks/cases"]
    return {
        "cells": str(sum(chart.size for chart in charts)),
        "misclassified": str(int(measured["stable_below"]["misclassified"]) or "none"),
        "stable_rate": number(measured["stable_below"]["fastest"], 2),
        "decay": number(slow["decay"]),
        "slow_l2": number(slow.sel(norm="l2"), 2),
        "slow_linf": number(slow.sel(norm="linf"), 2),
        "sites": str(int(sharp["sites"][-1])),
        **{
            f"short_of_{form}": percent(1.0 - reached.sel(form=form), 2)
            for form in ("theorem_1", "theorem_2", "theorem_3")
        },
        "reached_ball": number(reached.sel(form="theorem_2_ball"), 2),
        "limit_constant": number(sharp["limit_constant"]),
        "least_constant": number(sharp["least_constant"]),
        "observed": span(cases["ratio"].values, 2),
        "broken_sites": number(printed["smallest"]),
        "printed_order": number(measured["slow_time"]["order_without_the_half"], 2),
        "right_order": number(measured["slow_time"]["order"], 2),
        "start": number(gap["start"]),
        "radius": number(gap["delta_0"]),
        "widened_radius": number(gap["widened_delta_0"]),
        "widened_bound": number(gap["widened_bound"]),
        "breaking": number(bootstrap["breaking"]),
        "allowed": number(bootstrap["allowed_power"]),
        "barrier": number(bootstrap["barrier_power"]),
    }
