"""A user's case of equations of one's own: configuration, notebook, checks, and what is refused."""

import numpy as np
import pytest
from pendula import Case, Model, check, simulate
from pendula.configuration.files import ConfigurationError, gather
from pendula.configuration.messages import load
from pendula.model import ModelError
from pendula.problem import Problem

DAMPED = """from pendula.model import abs2, lap
fields = "u"
parameters = {"epsilon": 1.0, "gamma": 0.1}
def i_dt(p, u):
    return p.epsilon * lap(u) + abs2(u) * u - 1j * p.gamma * u
"""
AMPLITUDES = """from pendula.model import abs2
from pendula.models.amplitudes import i_dt
fields = "A", "B"
parameters = {"epsilon": 1.0, "gamma": 1.0, "omega": -4.0}
def conserved(p, a, b):
    def of(u):
        return abs2(u) ** 2 / 4 + p.omega * abs2(u) - p.epsilon * abs2(u.right - u)
    return {"H": of(a) + of(b) - p.gamma * (a - b) ** 2}
"""


@pytest.fixture
def configured(tmp_path):
    """Return a function: the problem of the case `mine` with these keys, and the damped model."""

    def make(keys, text=DAMPED):
        (tmp_path / "mine.py").write_text(text, encoding="utf-8")
        path = tmp_path / "mine.yaml"
        path.write_text(f"cases: {{mine: {{model: mine.py, {keys}}}}}", encoding="utf-8")
        return load(gather([path], {})).shown_problem("mine")

    return make


def test_a_case_holds_the_text_of_its_model_and_no_path(configured, tmp_path):
    plain = configured("initial: {0: [1.5]}, half_width: 4, parameters: {gamma: 0.2}")
    assert plain["model"] == {"name": "mine.py", "text": DAMPED}
    assert plain["parameters"] == {"gamma": 0.2} and not {"omega", "mu"} & plain.keys()
    assert str(tmp_path) not in str(plain)
    assert Problem.of(plain).plain() == {**plain, "snapshot_every": plain["snapshot_every"]}


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ("initial: {0: [1]}, parameters: {gama: 1}", "did you mean 'gamma'?"),
        (
            "initial: {0: [1]}, parameters: {gamma: {a: 1}}",
            "not a number or a list of one for each",
        ),
        ("initial: {0: [1]}, parameters: {gamma: .inf}", "gamma: is inf, which is not finite"),
        ("initial: {0: [1, 2]}", "site 0 has 2 values; give 1, [u]"),
        ("initial: {0: [1]}, omega: 1", "omega: belongs to the paper's equations"),
        ("initial: {0: [1]}, half_width: 2, parameters: {gamma: [1, 2]}", "2 values for 5 sites"),
        ("initial: {0: [1]}, solver: kahan_li", "kahan_li does not take models of one's own"),
        ("half_width: 2", "initial: is missing"),
        ("initial: {0: [1.0e+6]}", "initial: the run turns the data by"),
        ("initial: {0: [1.0e+200]}", "initial: the squares of the data or the constants overflow"),
        ("initial: {0: [1.0e-160]}", "initial: the data are so small"),
        ("initial: {0: [1]}, parameters: {epsilon: 1.0e+9}", "parameters: the run turns the data"),
    ],
)
def test_faults_of_a_case_are_told_by_key(configured, keys, message):
    with pytest.raises(ConfigurationError) as error:
        configured(keys)
    assert message in str(error.value)


@pytest.mark.parametrize(
    ("statement", "message"),
    [
        ("import numpy; return numpy.exp(u)", "exp of a field or a parameter has no rule"),
        ("return u if p.gamma > 0 else 2 * u", "a comparison or a branch is taken from a symbol"),
        ("return abs(u) * u", "abs has no rule; abs2 is the squared modulus"),
        ("return u / u", "a division by a field"),
        ("return p.gama * u", "there is no parameter 'gama'; did you mean 'gamma'?"),
        ("return u ** 0.5", "the power 0.5"),
        ("return shift(u, 9)", "farther than 7 sites"),
        ("return sin(u)", "sin of a complex number has no rule"),
        ("return u, u", "returns 2 values for 1 fields"),
    ],
)
def test_what_has_no_rule_is_refused_with_the_line_of_the_file(statement, message):
    text = "from pendula.model import *\nfields = 'u'\nparameters = {'gamma': 1}\n"
    with pytest.raises(ModelError) as error:
        Model.of_text("mine.py", f"{text}def i_dt(p, u):\n    {statement}\n")
    assert message in str(error.value)
    assert "returns" in message or str(error.value).startswith("mine.py, line 5: ")


def test_the_papers_equations_as_a_model_of_ones_own_give_the_papers_run():
    data = {"half_width": 5, "initial": {0: (1, 0.1), 2: (0.2j, 0)}, "end_time": 6}
    model = Model.of_text("amplitudes.py", AMPLITUDES)
    own, paper = Case(model=model, **data), Case(omega=-4, **data)
    run, expected = simulate(own), simulate(paper)
    np.testing.assert_array_equal(run["linf"], expected["linf"])
    energy = expected["energy"].values[:: expected.attrs["snapshot_every"]]
    np.testing.assert_allclose(run["conserved"][0], energy, rtol=1e-12)
    found = check(own, run)
    assert float(found["largest_difference"]) < 1e-10
    assert float(found["conserved_drift"][0]) < 1e-11
    late = float(check(paper, expected)["exponent"])
    assert float(found["exponent"]) == pytest.approx(late, abs=0.1)
