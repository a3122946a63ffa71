"""Spectra and sections in a configuration: as in a notebook, and the words for what they may not.

The judges are the mean divergence of the Lorenz equations, which is the sum of their exponents, and
the crossings of a pendulum without friction by SciPy.
"""

import numpy as np
import pytest
from latticode import Case, section
from latticode.configuration.files import ConfigurationError, gather
from latticode.datasets.motions import find_section, measure_exponents
from pendula.configuration.messages import load
from pendula.problem import PaperProblem
from scipy.integrate import solve_ivp

LORENZ = """
fields = ("x", "y", "z")
parameters = {"rho": 28.0}

def dt(p, x, y, z):
    return 10 * (y - x), x * (p.rho - z) - y, x * y - 8 / 3 * z

def plane(p, x, y, z):
    return z - p.rho + 1

def moment(p, x, y, z):
    return p.t

level = 27
"""
PENDULUM = """
from latticode import sin

fields, parameters = "x", {}

def d2_dt2(p, x):
    return -sin(x)

def turning(p, x, v):
    return v
"""
CASES = """
cases:
  lorenz: {model: lorenz.py, sites: 1, initial: {0: [1, 1, 20]}, end_time: 40}
  pendulum: {model: pendulum.py, sites: 1, initial: {0: [3]}, end_time: 20}
"""


@pytest.fixture
def loaded(tmp_path):
    (tmp_path / "lorenz.py").write_text(LORENZ)
    (tmp_path / "pendulum.py").write_text(PENDULUM)

    def load_with(text):
        (tmp_path / "mine.yaml").write_text(CASES + text)
        return load(gather([tmp_path / "mine.yaml"], {}))

    return load_with


def test_the_exponents_of_a_configuration_sum_to_the_divergence(loaded):
    settings = loaded("spectra: {three: {case: lorenz, count: 3}}")
    problem = PaperProblem.of(settings.problem("lorenz"))
    spectrum = measure_exponents(problem, settings.spectra["three"].count, "three")
    assert float(spectrum["exponent"].sum()) == pytest.approx(-10 - 1 - 8 / 3, abs=1e-4)
    assert spectrum.attrs["case"] == "three"


def test_a_section_turns_where_the_pendulum_does(loaded):
    """A pendulum that is let go at rest turns at the half periods, at both of its ends."""
    settings = loaded("sections: {ends: {case: pendulum, when: pendulum.py:turning, site: 0}}")
    problem = PaperProblem.of(settings.problem("pendulum"))
    when, entry = settings.plain_when("ends"), settings.sections["ends"]
    turns = find_section(problem, when, entry.direction, entry.site, "ends")

    def turning(t, y):
        return y[1] if t > 0.1 else -1.0

    turning.direction = 1
    judge = solve_ivp(
        lambda t, y: [y[1], -np.sin(y[0])], (0, 20), [3, 0], "DOP853",
        events=turning, rtol=1e-13, atol=1e-13,
    )  # fmt: skip
    assert len(judge.t_events[0]) == 1
    np.testing.assert_allclose(turns["crossing_tau"].values, judge.t_events[0], rtol=0, atol=1e-9)
    assert turns.attrs["when"] == "turning"


def test_a_section_is_that_of_a_notebook(loaded, tmp_path):
    settings = loaded("sections: {down: {case: lorenz, when: lorenz.py:plane, direction: down}}")
    problem = PaperProblem.of(settings.problem("lorenz"))
    when, entry = settings.plain_when("down"), settings.sections["down"]
    crossings = find_section(problem, when, entry.direction, entry.site, "down")
    model = tmp_path / "lorenz.py"
    case = Case(model=model, sites=1, initial={0: [1, 1, 20]}, end_time=40)
    of_notebook = section(case, lambda p, x, y, z: z - 27, "down")
    assert crossings["crossing_tau"].size > 20
    assert np.array_equal(crossings["crossing_tau"], of_notebook["crossing_tau"])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("spectra: {a: {case: lorenz, count: 4}}", "spectra.a.count: is 4; give .* from 1 to 3"),
        ("spectra: {a: {case: lorenz, count: 0}}", "spectra.a.count: is 0; it must be at least 1"),
        ("spectra: {a: {case: lorentz}}", "there is no case 'lorentz'; did you mean 'lorenz'"),
        ("spectra: {a: {case: lorenz}, A: {case: lorenz}}", "spectra.A: differs from 'a' only in"),
        ("sections: {a: {case: lorenz}}", "sections.a.when: is missing"),
        ("sections: {a: {case: lorenz, when: z}}", "when: is 'z'; give a function of a file, such"),
        ("sections: {a: {case: lorenz, when: no.py:z}}", "when: .*no.py cannot be read: No such"),
        ("sections: {a: {case: lorenz, when: lorenz.py:z}}", "when: lorenz.py has no function z"),
        ("sections: {a: {case: lorenz, when: lorenz.py:level}}", "lorenz.py has no function level"),
        ("sections: {a: {case: lorenz, when: lorenz.py:moment}}", "when: moment depends on no fie"),
        ("sections: {a: {case: lorenz, when: pendulum.py:turning}}", "turning must take .p, x, y"),
        ("sections: {a: {case: lorenz, when: lorenz.py:plane, site: 1}}", "site: is 1; the sites"),
        ("sections: {a: {case: lorenz, when: lorenz.py:plane, direction: in}}", "direction: "),
        (
            "  long: {model: lorenz.py, sites: 3000, initial: {0: [1, 1, 20]}, end_time: 40}\n"
            "spectra: {a: {case: long, count: 9000}}",
            "spectra.a.count: the run would take",
        ),
    ],
)
def test_what_cannot_be_measured_is_refused_in_words(loaded, text, message):
    with pytest.raises(ConfigurationError, match=message):
        loaded(text)
