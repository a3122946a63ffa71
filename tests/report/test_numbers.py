"""How numbers are written, and that each leads to its dataset."""

import numpy as np
import pytest
from pendula.report.results import ReportError, Results
from pendula.report.words import (
    Quote,
    case_in_words,
    markdown,
    measured,
    number,
    percent,
    plainly,
    span,
    symbols,
    with_error,
)

WRITTEN = [
    (number(2.9124), "2.91"),
    (number(-4.0), "−4"),
    (number(1e-6), "10⁻⁶"),
    (number(0.00012), "1.2 × 10⁻⁴"),
    (number(-1.25e9), "−1.25 × 10⁹"),
    (number(0), "0"),
    (number(np.nan), "none"),
    (number(-np.inf), "−infinite"),
    (measured(1.0), "1.00"),  # final zeros were measured
    (measured(52.0), "52.0"),
    (measured(123.4), "123"),
    (measured(2.5e-7), "2.5 × 10⁻⁷"),
    (with_error(0.50809, 0.00345), "0.508 ± 0.003"),  # the error sets the digits
    (with_error(0.50809, 0.00138), "0.5081 ± 0.0014"),
    (with_error(-7.78631e-4, 5e-9), "(−7.78631 ± 0.00005) × 10⁻⁴"),
    (with_error(5e-4, 7e-4), "(5 ± 7) × 10⁻⁴"),
    (with_error(2.5, np.nan), "2.5"),
    (span([3.0, np.nan, 1.0]), "1.00 to 3.00"),
    (span([2.0, 2.0]), "2.00"),
    (span([np.nan]), "none"),
    (percent(0.1287), "13 %"),
    (percent(398 / 400), "99.5 %"),
    (percent(0.9996), "99.96 %"),
    (percent(1.0), "100 %"),
    (percent(-0.0018), "−0.18 %"),
    (symbols("l2 <= exp(4 |gamma tau|) at Omega = -4"), "ℓ² ≤ exp(4 |γ τ|) at Ω = −4"),
    (symbols("order of 1e-6, mu^2, mu^1.0, a gammaray"), "order of 10⁻⁶, μ², μ^1.0, a gammaray"),
    (symbols("the slope of l2^2 over 2 v P"), "the slope of (ℓ²)² over 2 v P"),
    (plainly("P_over_C0_delta"), "P / C0 δ"),
    (case_in_words(-4.0, '{"0": [5.0, 1.0]}'), "Ω = −4, (A₀, B₀) = (5, 1)"),
    (case_in_words(0.5, '{"-3": ["-0.3+0.4j", 1.0]}'), "Ω = 0.5, (A₋₃, B₋₃) = (-0.3+0.4j, 1)"),
    (case_in_words(0, '{"0": [1, 0], "1": [1, 0]}'), "Ω = 0, data on 2 sites"),
]


@pytest.mark.parametrize(("found", "expected"), WRITTEN, ids=[text for _, text in WRITTEN])
def test_numbers_and_cases_are_written(found, expected):
    assert found.replace("\N{NO-BREAK SPACE}", " ") == expected


def test_links_are_seen_from_the_page():
    results = Results(["out/checks/a.nc", "out/claims.json"], "out/report.html")
    assert results.say("checks/a", "1") == Quote("1", "checks/a.nc")
    assert results.say("claims.json", "1").link == "claims.json"
    with pytest.raises(ReportError, match=r"needs checks/b.*add it to the inputs"):
        results.say("checks/b", "1")


def test_a_table_keeps_its_texts_and_escapes_bars():
    lines = markdown(["case", "|A|"], [["fig2", "1.0e-03"], ["nan", 2.50]]).splitlines()
    assert lines[0] == "| case | \\|A\\| |"
    assert set(lines[1]) == {"|", "-"} and lines[1].count("|") == 3
    assert lines[2:] == ["| fig2 | 1.0e-03 |", "| nan | 2.5 |"]
    assert markdown(["case", "time"], []).splitlines()[0] == "| case | time |"
