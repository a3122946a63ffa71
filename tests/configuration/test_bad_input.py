"""What people type by mistake or on purpose, each with the sentence that they are told."""

import copy
import datetime
import random
import re
import time
from pathlib import Path

import pytest
import yaml
from latticode.configuration.files import ConfigurationError, gather, merge, read
from pendula.configuration.messages import STUDIES, load, require
from pendula.configuration.schema import PAPER_CASES, PAPER_SWEEPS

ROOT = Path(__file__).resolve().parents[2]
CONFIG = gather([ROOT / "config/config.yaml"], {})
COMPLETE = gather([ROOT / f"config/{name}.yaml" for name in ("config", *STUDIES)], {})
SOLVERS = ["ode45", "crank_nicolson", "delfour_fortin_payre"]


def faults(text: str | bytes, folder: Path, below: dict = CONFIG) -> list[str]:
    """Return what a user is told who gives this text by --configfile."""
    path = folder / "mine.yaml"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    try:
        require(load(merge(below, read(path))), PAPER_CASES, PAPER_SWEEPS, SOLVERS)
    except ConfigurationError as error:
        output = re.sub(r"about \d+ \w+ and [\d.]+ \w+ of memory", "SO MUCH", str(error))
        return output.split("\n  ")[1:]
    return ["nothing"]


FORMS = {
    "files": ("HERE", "", CONFIG),
    "case": ("cases: {mine: {omega: 1, HERE}}", "cases.mine.", CONFIG),
    "sweep": ("cases: {mine: {omega: 1}}\nsweeps: {s: {case: mine, HERE}}", "sweeps.s.", CONFIG),
    "rest": ("HERE", "", COMPLETE),
    "study": ("HERE", "", COMPLETE),
}
"""Where the texts of each part of the table stand, how their sentences start, and below what."""


@pytest.fixture(scope="module")
def table():
    blocks = yaml.safe_load((Path(__file__).parent / "bad_input.yaml").read_text())
    assert blocks.keys() == FORMS.keys()
    return blocks


@pytest.mark.parametrize("block", FORMS)
def test_every_fault_is_told_in_the_words_of_the_table(block, table, tmp_path):
    form, start, below = FORMS[block]
    output = {
        text: faults(form.replace("HERE", text), tmp_path, below)[0] for text, _ in table[block]
    }
    assert output == {text: start + words for text, words in table[block]}


DIGITS = "1" * 400


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[" * 40 + "]" * 40, "line 1: is nested more than 30 deep"),
        (f"cases: {{mine: {{omega: {DIGITS}}}}}", "omega: is a whole number of 400 digits, too"),
        (f"cases: {{mine: {{omega: {'1' * 5000}}}}}", f"{'1' * 60} is not a number that can be"),
        (f"cases: {{mine: {{omega: 1, initial: {{{DIGITS}: [1, 0]}}}}}}", "number of 400 digits"),
        (f"cases: {{mine: {{omega: {'9' * 60}x}}}}", f"is '{'9' * 59}..., not a number"),
    ],
    ids=range(5),
)
def test_what_is_too_long_to_print_is_told_in_a_short_line(text, words, tmp_path):
    (line,) = faults(text, tmp_path)
    assert words in line and len(line) < 200


def listed(count: int) -> str:
    return f"[{', '.join(map(str, range(5, 5 + count)))}, 5]"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (f"breathers: {{steady: {{omegas: {listed(1_000_000)}}}}}", "more than 100000 values"),
        (f'{{"breathers": {{"steady": {{"omegas": {listed(1_000_000)}}}}}}}', "more than 100000 v"),
        (f"breathers: {{steady: {{omegas: {listed(30_000)}}}}}", "same value is given twice: 5"),
    ],
    ids=["YAML", "JSON", "fewer, which are read"],
)
def test_a_list_that_is_too_long_is_refused_in_two_seconds(text, words, tmp_path):
    begun = time.process_time()
    (line,) = faults(text, tmp_path, COMPLETE)
    assert time.process_time() - begun < 2.0
    assert words in line and len(line) < 200


def test_what_is_no_file_in_utf_8_is_told(tmp_path):
    path = tmp_path / "mine.yaml"
    for code in ("utf-16", "latin-1"):
        path.write_bytes("cases: {möwe: {omega: 1}}".encode(code))
        with pytest.raises(ConfigurationError, match=r"mine.yaml is not text in UTF-8: save it"):
            read(path)
    with pytest.raises(ConfigurationError, match=r"there is no file .*none.yaml"):
        read(tmp_path / "none.yaml")
    with pytest.raises(ConfigurationError, match=r"cannot be read: Is a directory"):
        read(tmp_path)


def test_what_is_odd_but_right_is_read(tmp_path):
    path = tmp_path / "mine.json"
    path.write_bytes(
        b'\xef\xbb\xbf{"cases":\t{"mine": {"omega": "1e-1", "initial": {"0": ["1 - 2j", 0]}}}}'
    )
    case = load(merge(CONFIG, read(path))).cases["mine"]
    assert case.omega == 0.1 and case.initial == {0: (1 - 2j, 0)}
    path.write_text(
        "cases: {mine: {omega: -0.0, end_time: 1, half_width: 1e4, initial: {-1E1: [1, 0]}}}\n"
        "sweeps: {s: {case: mine, windows: [[0, 1]], half_widths: [1e2, 1e+1, 200e-1, '3e1']}}"
    )
    actual = load(merge(CONFIG, read(path)))
    case = actual.cases["mine"]
    assert str(case.omega) == "0.0" and case.half_width == 10_000 and case.initial == {-10: (1, 0)}
    assert list(actual.sweeps["s"].half_widths) == [100, 10, 20, 30]


@pytest.mark.parametrize(
    ("text", "messages"),
    [
        ("solvers: {ode45: {rtol: 0}}", ["solvers.ode45.rtol: is 0; it must be greater than 0"]),
        # the sound part of shared controls is kept: 1e-14 would not do for such data
        (
            "solvers: {taylor: {rtol: 0, atol: 1e-40}}\n"
            "cases: {mine: {omega: 1, initial: {0: [1e-25, 0]}},"
            " other: {omega: 1, solver: {name: taylor, rtol: -1}}}",
            [
                "cases.other.solver.rtol: is -1; it must be greater than 0",
                "solvers.taylor.rtol: is 0; it must be greater than 0",
            ],
        ),
    ],
)
def test_a_fault_of_shared_controls_is_told_once_and_not_of_each_case(text, messages, tmp_path):
    assert faults(text, tmp_path) == messages


def test_initial_data_and_other_solvers_replace_what_stands_and_other_keys_are_added():
    above = {"cases": {"fig2_small": {"initial": {3: [1, 0]}, "end_time": 4}}}
    case = load(merge(CONFIG, above)).cases["fig2_small"]
    assert case.initial == {3: (1, 0)} and case.end_time == 4
    assert case.omega == CONFIG["cases"]["fig2_small"]["omega"]
    values = {"solver": {"name": "dop853", "rtol": 1e-9, "atol": 1e-3}}
    assert merge(values, {"solver": {"atol": 1e-5}})["solver"] == {**values["solver"], "atol": 1e-5}
    second = {"name": "crank_nicolson", "step": 0.001}
    assert merge(values, {"solver": second})["solver"] == second


ODD = [
    None,
    True,
    0,
    -1,
    3.7,
    -0.0,
    float("nan"),
    float("inf"),
    1e308,
    1e-320,
    10**30,
    10**400,
    "",
    "x",
    "1 2",
    "010",
    [],
    [1],
    [[1]],
    [None],
    {},
    {"a": 1},
    {0: 1},
    {None: 1},
    [1, 2, 3],
    "\0",
    b"x",
    datetime.date(2020, 1, 1),
    {"name": "taylor"},
    {1: [1, 2]},
    "nan",
    2**63,
    "1e5",
    [0.5, "x"],
]


def places(section, above=()):
    """Yield the path of every value of a configuration."""
    for key, value in section.items() if isinstance(section, dict) else enumerate(section):
        yield (*above, key)
        if isinstance(value, dict | list):
            yield from places(value, (*above, key))


@pytest.mark.parametrize("seed", range(4))
def test_an_odd_value_anywhere_is_read_or_told_in_our_words(seed):
    chance, everywhere = random.Random(seed), list(places(COMPLETE))
    message = 0
    for place in chance.sample(everywhere, 60):
        changed = copy.deepcopy(COMPLETE)
        section = changed
        for key in place[:-1]:
            section = section[key]
        section[place[-1]] = copy.deepcopy(chance.choice(ODD))
        try:
            require(load(changed), PAPER_CASES, PAPER_SWEEPS, SOLVERS)
        except ConfigurationError as fault:
            message += 1
            assert "Input" not in str(fault) and "should" not in str(fault)
    assert message > 30
