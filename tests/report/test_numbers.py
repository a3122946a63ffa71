"""How numbers are written, and that each leads to its dataset."""

import numpy as np
import pytest
from markupsafe import escape
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
    told,
    with_error,
    write_markdown,
)


def plain(text: str) -> str:
    """Return a text with spaces where it must not be broken."""
    return text.replace("\N{NO-BREAK SPACE}", " ")


@pytest.mark.parametrize(
    ("value", "written"),
    [
        (2.9124, "2.91"),
        (-4.0, "−4"),
        (1e-6, "10⁻⁶"),
        (0.00012, "1.2 × 10⁻⁴"),
        (-1.25e9, "−1.25 × 10⁹"),
        (0, "0"),
        (np.nan, "none"),
        (np.inf, "infinite"),
        (-np.inf, "−infinite"),
    ],
)
def test_a_number(value, written):
    assert plain(number(value)) == written


def test_measured_numbers_keep_their_zeros():
    assert [measured(v) for v in (1.0, 52.0, 0.5)] == ["1.00", "52.0", "0.500"]
    assert measured(123.4) == "123" and plain(measured(2.5e-7)) == "2.5 × 10⁻⁷"


def test_an_error_sets_the_digits_of_its_number():
    assert plain(with_error(0.50809, 0.00345)) == "0.508 ± 0.003"
    assert plain(with_error(0.50809, 0.00138)) == "0.5081 ± 0.0014"
    assert plain(with_error(-7.78631e-4, 5e-9)) == "(−7.78631 ± 0.00005) × 10⁻⁴"
    assert plain(with_error(5e-4, 7e-4)) == "(5 ± 7) × 10⁻⁴"
    assert with_error(2.5, np.nan) == "2.5"


def test_a_text_of_html_takes_numbers_as_links():
    text = told("{n} &lt; <b>{m}</b>", n=Quote("1", "a.nc"), m="<2>")
    assert text == '<a class="n" href="a.nc">1</a> &lt; <b>&lt;2&gt;</b>'


def test_spans_and_parts():
    assert span([3.0, np.nan, 1.0]) == "1.00 to 3.00"
    assert span([2.0, 2.0]) == "2.00" and span([np.nan]) == "none"
    assert [percent(part) for part in (0.1287, 3.04, -0.0018)] == [
        "13\N{NO-BREAK SPACE}%", "304\N{NO-BREAK SPACE}%", "−0.18\N{NO-BREAK SPACE}%"
    ]  # fmt: skip


def test_a_quote_is_a_link_to_its_dataset_and_is_escaped():
    assert escape(Quote("1 < 2", "checks/a.nc")) == '<a class="n" href="checks/a.nc">1 &lt; 2</a>'
    assert str(Quote("2", "checks/a.nc")) == "2"


def test_words_of_the_ledger_get_their_symbols():
    assert symbols("l2 <= exp(4 |gamma tau|) at Omega = -4") == "ℓ² ≤ exp(4 |γ τ|) at Ω = −4"
    assert symbols("order of 1e-6, mu^2, mu^1.0, l-infinity") == "order of 10⁻⁶, μ², μ^1.0, ℓ∞"
    assert symbols("a gammaray") == "a gammaray"
    assert symbols("the slope of l2^2 over 2 v P") == "the slope of (ℓ²)² over 2 v P"
    assert plainly("P_over_C0_delta") == "P / C0 δ"


def test_cases_in_words():
    words = plain(case_in_words(-4.0, '{"0": [5.0, 1.0]}'))
    assert words == "Ω = −4, (A₀, B₀) = (5, 1)"
    words = plain(case_in_words(0.5, '{"-3": ["-0.3+0.4j", 1.0]}'))
    assert words == "Ω = 0.5, (A₋₃, B₋₃) = (-0.3+0.4j, 1)"
    assert "data on 2 sites" in case_in_words(0, '{"0": [1, 0], "1": [1, 0]}')


def test_a_table_keeps_its_texts_and_escapes_bars():
    lines = markdown(["case", "|A|"], [["fig2", "1.0e-03"], ["nan", 2.50]]).splitlines()
    assert lines[0] == "| case | \\|A\\| |"
    assert set(lines[1]) == {"|", "-"} and lines[1].count("|") == 3
    assert lines[2:] == ["| fig2 | 1.0e-03 |", "| nan | 2.5 |"]
    assert markdown(["case", "time"], []).splitlines()[0] == "| case | time |"


def test_a_page_of_markdown_has_empty_lines_between_its_parts(tmp_path):
    write_markdown(tmp_path / "page.md", "# Title", "Words.", markdown(["a"], [["1"]]))
    assert (tmp_path / "page.md").read_text() == "# Title\n\nWords.\n\n| a |\n|-----|\n| 1 |\n"
