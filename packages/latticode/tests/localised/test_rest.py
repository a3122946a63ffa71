"""One site alone, and sites that rest at an unstable point beside those that move."""

import numpy as np
import pytest
from latticode import Case, ConfigurationError, Model, abs2, check, lap, simulate, survey
from latticode.checks import UNSTABLE_REST
from latticode.configuration.files import gather
from latticode.configuration.schema import load
from latticode.simulation.problem import Problem
from scipy.integrate import solve_ivp

LORENZ = """
fields = "x", "y", "z"
parameters = {"r": 28.0}
def i_dt(p, a, b, c):
    x, y, z = a.real, b.real, c.real
    return 1j * 10 * (y - x), 1j * (x * (p.r - z) - y), 1j * (x * y - 8 / 3 * z)
"""


@pytest.fixture(scope="module")
def lorenz(tmp_path_factory):
    """Return a case of Lorenz' equations on one site."""
    path = tmp_path_factory.mktemp("models") / "lorenz.py"
    path.write_text(LORENZ, encoding="utf-8")
    return Case(model=path, half_width=0, initial={0: [1, 1, 20]}, end_time=20, output_step=0.1)


def test_one_site_alone_is_what_scipy_makes_of_it(lorenz):
    def rate(t, state):
        x, y, z = state
        return 10 * (y - x), x * (28 - z) - y, x * y - 8 / 3 * z

    run = simulate(lorenz.changed(end_time=5))
    expected = solve_ivp(rate, (0, 5), [1, 1, 20], method="DOP853", rtol=1e-12, atol=1e-13)
    assert run["final"].sizes["site"] == 1
    final = run["final"].sel(part="re", site=0)
    np.testing.assert_allclose(final, expected.y[:, -1], rtol=0, atol=1e-8)


def test_a_survey_and_a_file_take_one_site_alone(lorenz, tmp_path):
    computed = survey(lorenz, {"half_width": [0, 1], "r": [0.5, 28]}, keep=["final_l2"])
    np.testing.assert_array_equal(computed["final_l2"][0], computed["final_l2"][1])
    (tmp_path / "lorenz.py").write_text(LORENZ, encoding="utf-8")
    text = "cases: {one: {model: lorenz.py, half_width: 0, initial: {0: [1, 1, 20]}}}"
    (tmp_path / "mine.yaml").write_text(text, encoding="utf-8")
    problem = load(gather([tmp_path / "mine.yaml"], {})).shown_problem("one")
    assert Problem.of(problem).sites == 1


@pytest.mark.parametrize(
    "functions",
    [
        {"i_dt": lambda p, u: lap(u)},
        {"i_dt": lambda p, u: abs2(u.right) * u},
        {"i_dt": lambda p, u: u, "conserved": lambda p, u: {"P": abs2(u - u.left)}},
    ],
)
def test_one_site_is_refused_where_a_neighbour_is_seen(functions):
    model = Model(fields="u", parameters={}, **functions)
    with pytest.raises(ConfigurationError, match="it must be at least 1, because the model uses"):
        Case(model=model, half_width=0, initial={0: [1]})


def test_sites_that_rest_at_an_unstable_point_are_pointed_out(lorenz, capsys):
    """The origin grows at (-11 + sqrt(1201)) / 2 = 11.83, the larger root of its 2 x 2 matrix."""
    computed = check(lorenz.changed(half_width=1))
    sentence = computed.attrs[UNSTABLE_REST]
    assert sentence.startswith("sites -1, 1 rest at an unstable point") and "11.83" in sentence
    assert "half_width: 0" in sentence and sentence in capsys.readouterr().out
    assert float(computed["exponent"]) == pytest.approx((-11 + 1201**0.5) / 2, abs=1e-3)


def phi4(coupling, **keys):
    """Return a case whose sites rest on top of a double well, but for one in a well."""
    model = Model(
        fields="x",
        parameters={"c": coupling},
        d2_dt2=lambda p, x: p.c * lap(x) + x - x * x * x,
    )
    return Case(model=model, half_width=3, end_time=20, **keys)


def test_a_resting_site_in_a_chain_is_at_its_own_place():
    computed = check(
        phi4(0.0, initial={0: [1.1], 1: [1.0], 2: [0.3], -1: [0.2], -2: [-1.0], 3: [1]})
    )
    sentence = computed.attrs[UNSTABLE_REST]
    assert sentence.startswith("site -3 rests at an unstable point, where a perturbation grows at")
    assert "the rate 1;" in sentence


@pytest.mark.parametrize(
    "case",
    [
        phi4(0.3, initial={0: [1.1]}),  # the coupling moves all sites
        phi4(0.0, initial={n: [1.0 + 0.01 * n] for n in range(-3, 4)}),
        phi4(0.0, initial={n: [1.0] for n in range(-3, 4)}),  # all rest, in their wells
    ],
)
def test_sites_that_move_or_rest_at_a_stable_point_are_not_pointed_out(case):
    assert UNSTABLE_REST not in check(case).attrs


def test_one_site_of_lorenz_has_its_published_exponent(lorenz):
    computed = check(lorenz.changed(end_time=1000))
    assert UNSTABLE_REST not in computed.attrs
    assert abs(float(computed["exponent"]) - 0.9056) < 4 * float(computed["exponent_error"]) < 0.06
