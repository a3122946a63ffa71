"""How numbers are written, and that each leads to its dataset."""

import numpy as np
import pytest
from pendula.case_words import case_in_words
from replication.results import ReportError, Results
from replication.words import (
    DOWN,
    UP,
    enclosing_span,
    markdown,
    number,
    outward,
    percent,
    plainly,
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
    (with_error(0.50809, 0.00345), "0.508 ± 0.004"),  # the error sets the digits
    (with_error(0.50809, 0.00138), "0.5081 ± 0.0014"),
    (with_error(-7.78631e-4, 5e-9), "(−7.78631 ± 0.00005) × 10⁻⁴"),
    (with_error(5e-4, 7e-4), "(5 ± 7) × 10⁻⁴"),
    (with_error(2.6551, 0.0209), "2.66 ± 0.03"),  # rounding the number widens the error
    (with_error(30.2522042, 1e-14, 4), "30.25"),  # the error of the arithmetic
    (with_error(2.5, np.nan), "2.5"),
    (enclosing_span(0.9473, 1.0021, 3), "0.947 to 1.003"),  # outward, to the same decimal places
    (enclosing_span(9.4, 10.5, 2), "9.4 to 10.5"),
    (enclosing_span(2.0, 2.0, 3), "2.00"),
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


@pytest.mark.parametrize(("printed", "expected"), WRITTEN, ids=[text for _, text in WRITTEN])
def test_numbers_and_cases_are_written(printed, expected):
    assert printed.replace("\N{NO-BREAK SPACE}", " ") == expected


def test_an_interval_that_is_written_contains_the_one_that_is_meant():
    draw = np.random.default_rng(5)
    values, errors = draw.normal(size=1000), 10.0 ** draw.uniform(-3, 1, size=1000)
    for value, error in zip(values, errors, strict=True):
        text = with_error(value, error).replace("−", "-")
        middle, width = map(float, text.split("\N{NO-BREAK SPACE}±\N{NO-BREAK SPACE}"))
        assert middle - width <= value - error + 1e-9 * error
        assert middle + width >= value + error - 1e-9 * error


@pytest.mark.parametrize(
    ("value", "digits", "down", "up"),
    [
        (7.85, 2, 7.8, 7.9),
        (-7.85, 2, -7.9, -7.8),
        (0.0507, 2, 0.05, 0.051),
        (33.14, 4, 33.14, 33.14),
        (9.96, 2, 9.9, 10.0),
        (0.0, 2, 0.0, 0.0),
        (np.inf, 2, np.inf, np.inf),
    ],
)
def test_numbers_are_rounded_outward(value, digits, down, up):
    bounds = outward(value, digits, DOWN), outward(value, digits, UP)
    np.testing.assert_allclose(bounds, (down, up), rtol=1e-12)


def test_links_are_seen_from_the_page():
    results = Results(["out/checks/a.nc", "out/claims.json"], "out/report.html")
    assert str(results.path("checks/a.nc")) == "out/checks/a.nc" and "checks/a" in results
    with pytest.raises(ReportError, match=r"needs checks/b.*add it to the inputs"):
        results.path("checks/b.nc")


def test_a_table_keeps_its_texts_and_escapes_bars():
    lines = markdown(["case", "|A|"], [["fig2", "1.0e-03"], ["nan", 2.50]]).splitlines()
    assert lines[0] == "| case | \\|A\\| |"
    assert set(lines[1]) == {"|", "-"} and lines[1].count("|") == 3
    assert lines[2:] == ["| fig2 | 1.0e-03 |", "| nan | 2.5 |"]
    assert markdown(["case", "time"], []).splitlines()[0] == "| case | time |"
