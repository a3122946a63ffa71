"""A case of a model: what a configuration and a notebook take, and what they refuse."""

import json

import numpy as np
import pytest
from latticode import Case, ConfigurationError, Model, ModelError, abs2, lap, simulate, sweep
from latticode.configuration.files import gather
from latticode.configuration.schema import load
from latticode.simulation.problem import Problem

DAMPED = """from latticode import abs2, lap
from latticode import abs2, lap
fields = "u"
parameters = {"epsilon": 1.0, "gamma": 0.1}
def i_dt(p, u):
    return p.epsilon * lap(u) + abs2(u) * u - 1j * p.gamma * u
"""


@pytest.fixture
def write(tmp_path):
    """Return a function: the model of a file with this text."""

    def write_model(text, name="mine.py"):
        (tmp_path / name).write_text(text, encoding="utf-8")
        return Model.read(tmp_path / name)

    return write_model


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
    entries = configured("initial: {0: [1.5]}, half_width: 4, parameters: {gamma: 0.2}")
    assert entries["model"]["name"] == "mine.py" and entries["model"]["text"] == DAMPED
    assert entries["parameters"] == {"epsilon": 1.0, "gamma": 0.2}
    assert str(tmp_path) not in str(entries)
    assert Problem.of(entries).plain() == entries


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ("initial: {0: [1]}, parameters: {gama: 1}", "did you mean 'gamma'?"),
        (
            "initial: {0: [1]}, parameters: {gamma: {a: 1}}",
            "not a number or a list with one for each site",
        ),
        ("initial: {0: [1]}, parameters: {gamma: .inf}", "gamma: is inf, which is not finite"),
        ("initial: [0, 0, 1, 0, 0]", "initial: has 5 values for 61 sites"),
        ("initial: {0: 1}", "site 0 has 1; give a list with a value for each field"),
        ("initial: {0: [1, 2]}", "site 0 has 2 values; give 1, [u]"),
        ("initial: {0: [1]}, omega: 1", "omega: is not a known key; give one of model, parameters"),
        ("initial: {0: [1]}, half_width: 2, parameters: {gamma: [1, 2]}", "2 values for 5 sites"),
        ("initial: {0: [1]}, solver: kahan_li", "kahan_li cannot integrate the model mine.py"),
        ("half_width: 2", "initial: is missing"),
        ("initial: {0: [1.0e+6]}", "initial: the phases advance by"),
        ("initial: {0: [1.0e+200]}", "initial: the squares of the data or the constants overflow"),
        ("initial: {0: [1.0e-160]}", "initial: the data are so small"),
        ("initial: {0: [1]}, parameters: {epsilon: 1.0e+9}", "parameters: the phases advance by"),
    ],
)
def test_faults_of_a_case_are_told_by_key(configured, keys, message):
    with pytest.raises(ConfigurationError) as error:
        configured(keys)
    assert message in str(error.value)


@pytest.mark.parametrize(
    ("statement", "message"),
    [
        (
            "import numpy; return numpy.tanh(u)",
            "tanh of a field or a parameter is not supported; write",
        ),
        ("import numpy; return numpy.angle(u)", "a field is its value at one site"),
        ("import numpy; return numpy.roll(u, 1)", "neighbours are u.left, u.right"),
        ("import numpy; return numpy.arange(5) * u", "a value for each site is a parameter"),
        ("return u[1] - u", "a field is its value at one site"),
        ("import math; return math.exp(abs2(u)) * u", "use functions of latticode"),
        ("return p['gamma'] * u", "write p.gamma"),
        ("return u - u.dt", "there is no .dt: a field has .real"),
        ("u * 2", "returns nothing"),
        ("return u if p.gamma > 0 else 2 * u", "a comparison or a branch uses a symbol"),
        ("return sqrt(u)", "sqrt of a complex number is not supported"),
        ("return p.gama * u", "there is no parameter 'gama'; did you mean 'gamma'?"),
        ("return u ** None", "the exponent is None; give a number or a parameter"),
        ("return shift(u, 9)", "a neighbour 9 sites away; the limit is 7"),
        ("return sin(u)", "sin of a complex number is not supported"),
        ("return u, u", "returns 2 values for 1 fields"),
    ],
)
def test_what_has_no_rule_is_refused_with_the_line_of_the_file(write, statement, message):
    text = "from latticode import *\nfields = 'u'\nparameters = {'gamma': 1}\n"
    with pytest.raises(ModelError) as error:
        write(f"{text}def i_dt(p, u):\n    {statement}\n")
    assert message in str(error.value)
    assert "returns" in message or str(error.value).startswith("mine.py, line 5: ")


def case(**keys):
    return Case(**{"half_width": 2, "initial": {0: [1]}, "end_time": 1, **keys})


@pytest.mark.parametrize(
    ("fields", "parameters", "message"),
    [
        ("u", {"t": 0.5}, "'t' in parameters is the time, p.t"),
        ("u", {"initial": 0.5}, "'initial' in parameters is a key of a case"),
        ("pair", {}, "'pair' in fields denotes all fields together in sweeps"),
        ("u", {"_names": 1}, "'_names' in parameters begins with _"),
        ("u", {"__class__": 1}, "begins with _"),
        ("u", {"a b": 1}, "'a b' in parameters is not a valid name in Python"),
        ("u", {"lambda": 1}, "is not a valid name in Python"),
        ("u", [("a", 1)], "parameters must be a dictionary"),
        (("u", "u"), {}, "'u' in fields is given twice"),
        ("", {}, "'' in fields is not a valid name in Python"),
        ("u, v", {}, "write fields = ('u', 'v')"),
        ((), {}, "fields is empty"),
        (2, {}, "fields is 2; give names"),
    ],
)
def test_names_that_cannot_stand_in_equations_are_refused(fields, parameters, message):
    with pytest.raises(ModelError) as error:
        Model(fields=fields, parameters=parameters, i_dt=lambda p, *u: u)
    assert message in str(error.value)


def case_with(value, by):
    """Return a case whose parameter `a` is given by the model or by the case."""
    model = Model(
        fields="u",
        parameters={"a": value if by == "model" else 1.0},
        i_dt=lambda p, u: lap(u) + p.a * u,
    )
    return case(model=model, parameters={} if by == "model" else {"a": value})


VALUES = [
    (np.float32(0.5), 0.5),
    (np.int64(2), 2.0),
    ("1e-5", 1e-5),
    (np.arange(5), [0, 1, 2, 3, 4]),
    ([1, 2, 3, 4, np.float32(5)], [1, 2, 3, 4, 5]),
    (lambda n: n * n, [4, 1, 0, 1, 4]),
    (lambda n: 3, 3.0),
]


@pytest.mark.parametrize(("entry", "value"), VALUES)
@pytest.mark.parametrize("by", ["model", "case"])
def test_values_of_parameters_are_taken_from_model_and_case_alike(entry, value, by):
    configured = case_with(entry, by)
    problem = Problem.of(configured.problem())
    assert problem.parameters == {"a": value}
    run, expected = simulate(configured), simulate(case_with(value, "case"))
    np.testing.assert_array_equal(run["final"], expected["final"])
    assert json.loads(run.attrs["parameters"]) == {"a": value}


WRONG = [
    (1j, "complex"),
    (np.ones(5) * 1j, "complex"),
    (lambda n: np.exp(1j * n), "complex"),
    (lambda n: 1 / n, "inf at site 0, which is not finite"),
    (lambda n: n[:2], "has 2 values for 5 sites"),
    (lambda n: None, "None, not a number"),
    (lambda n: np.random.default_rng().normal(size=n.size), "different values each time"),
    (lambda n: n.missing, "a function of the sites that fails: AttributeError"),
    (np.ones((2, 5)), "has 2 x 5 values for 5 sites"),
    ([1, [2]], "not a number"),
    ({"a": 1}, "not a number"),
    (None, "None, not a number"),
    (True, "True, not a number"),
    ("abc", "'abc', not a number"),
    (np.inf, "inf, which is not finite"),
    (np.ones(3), "has 3 values for 5 sites"),
]


@pytest.mark.parametrize(("value", "message"), WRONG)
@pytest.mark.parametrize("by", ["model", "case"])
def test_values_that_are_no_parameters_are_refused_before_any_run(value, message, by):
    with pytest.raises(ConfigurationError) as error:
        case_with(value, by)
    assert "parameters.a: " in str(error.value) and message in str(error.value)
    assert ("(the default in model)" in str(error.value)) == (by == "model")
    assert "has 1 error:" in str(error.value)


READS = """from pathlib import Path
import numpy as np
from latticode import lap
from beside import SCALE
fields = "u"
parameters = {"W": np.loadtxt(Path(__file__).with_name("W.txt"))}
def i_dt(p, u):
    return SCALE * lap(u) + p.W * u
"""


def test_files_and_modules_beside_a_model_are_read_and_decide_its_jobs(configured, tmp_path):
    keys = "initial: {0: [1]}, half_width: 1"
    np.savetxt(tmp_path / "W.txt", [1, 2, 3])
    (tmp_path / "beside.py").write_text("SCALE = 2.0\n", encoding="utf-8")
    first = configured(keys, READS)
    assert first["parameters"] == {"W": [1.0, 2.0, 3.0]}
    np.savetxt(tmp_path / "W.txt", [1, 2, 4])
    (tmp_path / "beside.py").write_text("SCALE = 3.0\n", encoding="utf-8")
    second = configured(keys, READS)
    assert second["parameters"] == {"W": [1.0, 2.0, 4.0]}
    assert second["model"]["nodes"] != first["model"]["nodes"]
    assert not list(tmp_path.glob("__pycache__"))


def test_a_model_without_a_seed_is_refused(write):
    draws = "import numpy as np\nfields = 'u'\nx = np.random.default_rng().normal()\n"
    with pytest.raises(ModelError, match="gives a a different value each time"):
        write(f"{draws}parameters = {{'a': x}}\ndef i_dt(p, u):\n    return u\n")
    with pytest.raises(ModelError, match="gives different equations each time"):
        write(f"{draws}parameters = {{}}\ndef i_dt(p, u):\n    return x * u\n")


OUTSIDE = np.random.default_rng(1)
CALLS = iter(range(100))
IMPURE = {
    "a draw without a seed": lambda p, u: np.random.default_rng().normal() * u,
    "a generator with a seed that goes on": lambda p, u: OUTSIDE.normal() * u,
    "a counter": lambda p, u: next(CALLS) * u,
}


@pytest.mark.parametrize("kind", IMPURE)
def test_equations_that_are_other_ones_each_time_are_refused_in_a_notebook(kind):
    with pytest.raises(ModelError, match="gives different equations each time") as error:
        Model(fields="u", parameters={}, i_dt=IMPURE[kind])
    assert "draw them outside and pass them as a parameter" in str(error.value)
    densities = {"P": IMPURE[kind]}
    with pytest.raises(ModelError, match="gives different equations each time"):
        Model(
            fields="u",
            parameters={},
            i_dt=lambda p, u: lap(u),
            conserved=lambda p, u: {"P": densities["P"](p, abs2(u))},
        )


def test_a_file_and_a_notebook_refuse_a_draw_in_the_equations_alike(write):
    text = "import numpy as np\nfields = 'u'\nparameters = {}\nrng = np.random.default_rng(1)\n"
    with pytest.raises(ModelError, match=r"different equations each time\. .*as a parameter"):
        write(f"{text}def i_dt(p, u):\n    return rng.normal() * u\n")


def test_numbers_drawn_before_the_equations_are_taken_as_parameters():
    drawn = np.random.default_rng(1).normal(size=7)
    noisy = Model(fields="u", parameters={"noise": drawn}, i_dt=lambda p, u: p.noise * u)
    run = simulate(case(model=noisy, half_width=3))
    assert f'"noise": [{drawn[0]}' in run.attrs["parameters"]


def test_a_configuration_carries_no_code():
    text = "raise SystemExit(3)"
    with pytest.raises(ConfigurationError, match="a configuration cannot contain code"):
        load({"cases": {"mine": {"model": {"name": "a.py", "text": text}, "initial": {0: [1]}}}})


@pytest.mark.parametrize(
    ("conserved", "message"),
    [
        (lambda p, u: {"P": p.t * abs2(u)}, "'P' in conserved depends on the time"),
        (lambda p, u: {"P": u * u}, "'P' in conserved is complex"),
        (lambda p, u: {"P": 2.0}, "'P' in conserved depends on no field"),
        (lambda p, u: abs2(u), "conserved must return a dictionary"),
    ],
)
def test_densities_that_no_run_can_keep_are_refused(conserved, message):
    with pytest.raises(ModelError) as error:
        Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u), conserved=conserved)
    assert message in str(error.value)


def test_a_complex_number_divides_as_it_multiplies():
    def by(factor):
        return Model(fields="u", parameters={"a": 0.5}, i_dt=factor)

    divided = by(lambda p, u: lap(u) / (p.a + 2j) + u.conj() / 2j + u.real)
    times = by(lambda p, u: lap(u) * (p.a - 2j) / (p.a * p.a + 4) - 0.5j * u.conj() + u.real)
    runs = [simulate(case(model=model))["final"] for model in (divided, times)]
    np.testing.assert_allclose(*runs, atol=1e-13)


def test_longer_chains_of_a_sweep_have_the_same_values_at_the_same_sites():
    def swept(values):
        model = Model(fields="u", parameters={"a": values}, i_dt=lambda p, u: lap(u) + p.a * u)
        return sweep(case(model=model, half_width=3, end_time=2), [1, 3], windows=[(1, 2)])["l2"]

    np.testing.assert_array_equal(swept(lambda n: n * n), swept([9, 4, 1, 0, 1, 4, 9]))
    with pytest.raises(ConfigurationError, match="values at a site change"):
        swept(lambda n: n + n.size)
