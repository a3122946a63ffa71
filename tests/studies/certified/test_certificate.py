"""The committed certificate, its checker, and planted errors that the checker must refuse."""

import ast
import copy
import json
import runpy
import subprocess
import sys

import numpy as np
import pytest
import yaml
from helpers import ROOT
from pendula.studies.certified.certificate import make_certificate
from problems import problem_of

CHECKER = ROOT / "scripts/check_certificate.py"
COMMITTED = ROOT / "tests/baseline/proofs/short_case.json"


@pytest.fixture(scope="module")
def committed():
    return json.loads(COMMITTED.read_text())


def test_a_stranger_needs_nothing_but_python(tmp_path):
    code = CHECKER.read_text()
    assert len(code.splitlines()) <= 270
    imports = [n for n in ast.walk(ast.parse(code)) if isinstance(n, ast.Import | ast.ImportFrom)]
    named = {
        (node.module if isinstance(node, ast.ImportFrom) else node.names[0].name)
        for node in imports
    }
    assert named == {"json", "re", "sys", "fractions", "math", "operator"}
    told = subprocess.run(
        [sys.executable, "-I", CHECKER, COMMITTED], capture_output=True, text=True, cwd=tmp_path
    )
    assert (told.returncode, told.stdout) == (0, "yes\n")


def test_the_committed_certificate_is_what_the_library_makes(committed):
    given = yaml.safe_load((ROOT / "config/certified.yaml").read_text())["certified"]["certificate"]
    assert make_certificate(problem_of(given.pop("case"), **given)) == committed


@pytest.fixture
def verdict(tmp_path, capsys):
    """Return a function that runs the script on a certificate, or on bytes: its line."""
    main = runpy.run_path(str(CHECKER))["main"]

    def run(given):
        path = tmp_path / "given.json"
        path.write_bytes(given if isinstance(given, bytes) else json.dumps(given).encode())
        status = main([str(path)])
        said = capsys.readouterr().out
        assert status == int(said != "yes\n")
        return said

    return run


@pytest.fixture(scope="module")
def short(committed):
    """Return the certificate of the first three steps."""
    return committed | {"steps": committed["steps"][:3], "end_time": "3/16"}


def changed(certificate, place, value):
    """Return a certificate with a value at a place; a function makes it of the old one."""
    made = inner = copy.deepcopy(certificate)
    for key in place[:-1]:
        inner = inner[key]
    inner[place[-1]] = value(inner[place[-1]]) if callable(value) else value
    return made


NO_INTEGER = (None, True, "1", 1.0, float("nan"), float("inf"), [1], {"1": 1})
NO_NUMBER = (
    None, True, 1, 0.1, ["1"], "", "one", "nan", "1e3", "0x1", "1_0", " 1", "1\n", "+1",
    "1/0", "1/-2", "1/2/3", "1.", ".5", "\u0661", "9" * 200,
)  # fmt: skip
NO_LIST = (None, True, 0, "1", {"0": 0}, [])
TERM, RATE, DATUM = ("steps", 1, "terms", 2, 0, 1), ("steps", 1, "rates", 0), ("initial", 2, 1)
BOUND, UNITS = ("steps", 1, "bound"), [("steps_per_tau",), ("bits",), ("rate_bits",)]
NUMBERS = [("epsilon",), ("gamma",), ("omega",), ("end_time",), DATUM]
OF_A_LENGTH = [DATUM[:1], DATUM[:2], TERM[:4], TERM[:5], ("initial",)]
FORM = [
    ([*UNITS, BOUND, TERM, RATE], NO_INTEGER),
    ([*UNITS, BOUND, RATE], (-1,)),
    ([*UNITS, BOUND], (0,)),
    (UNITS, (10**400,)),
    (NUMBERS, NO_NUMBER),
    ([*OF_A_LENGTH, ("steps",), TERM[:3], RATE[:-1]], NO_LIST),
    (OF_A_LENGTH, (lambda items: items[:-1], lambda items: [*items, items[0]])),
    ([RATE[:-1]], (lambda rates: rates[:1],)),
    ([("what",)], (None, 1, "", "free ends", lambda text: text + " ")),
    ([("steps", 1)], (None, 1, "step", [], [1])),
]
"""Places in a certificate with values, or changes, that none of them may have."""


@pytest.mark.parametrize(
    ("place", "value"), [(p, v) for places, values in FORM for p in places for v in values]
)
def test_a_field_of_another_form_is_rejected_by_its_name(place, value, short, verdict):
    said = verdict(changed(short, place, value))
    names = [f"[{key}]" if isinstance(key, int) else f".{key}" for key in place]
    within = ["no: " + "".join(names[: i + 1]).removeprefix(".") for i in range(len(names))]
    assert said.startswith(tuple(within)) and " must " in said, said
    assert said.count("\n") == 1 and len(said) < 120


def test_a_key_too_few_or_too_many_is_rejected(short, verdict):
    step = short["steps"][1]
    for key in short:
        assert f" lacks {key}\n" in verdict({k: v for k, v in short.items() if k != key})
    for key in step:
        lacking = {k: v for k, v in step.items() if k != key}
        assert f" lacks {key}\n" in verdict(changed(short, ("steps", 1), lacking))
    for more in (short | {"bounds": 1}, changed(short, ("steps", 1), step | {"bounds": 1})):
        assert "must not have the key 'bounds'" in verdict(more)


@pytest.mark.parametrize(
    ("given", "reason"),
    [
        (b"[]", "must be an object"),
        (b'{"\\ud800": 1}', "lacks what"),
        (b"", "valid JSON"),
        (b'{"what": "\xff"}', "UTF-8"),
        (b"[" * 100_000, "valid JSON"),
        (b'{"what": 1, "what": 2}', "same key twice"),
        (b'{"bits": ' + b"9" * 10_000 + b"}", "valid JSON"),
    ],
    ids=range(7),
)
def test_a_file_that_is_no_certificate_is_rejected(given, reason, verdict):
    said = verdict(given)
    assert said.startswith("no: ") and reason in said


def test_a_path_that_is_none_is_rejected(capsys):
    main = runpy.run_path(str(CHECKER))["main"]
    for paths, reason in ((["none.json"], "the file cannot"), ([], "give the path")):
        assert main(paths) == 1 and capsys.readouterr().out.startswith(f"no: {reason}")


def of_term(number, order, row, site, by=1):
    return ("steps", number, "terms", order, row, site), lambda value: value + by


def of_step(number, name, how):
    return ("steps", number, name), how


PLANTED = {  # in the first three steps; the field that the sentence names
    "the last digit of data": (*of_term(0, 0, 0, 1), "steps[0].bound"),
    "the last digit of a late coefficient": (*of_term(1, 3, 0, 1), "steps[1].bound"),
    "the last digits of the highest term": (*of_term(1, 14, 3, 2, 99), "steps[1].bound"),
    "a coefficient of the other sign": (
        ("steps", 0, "terms", 4, 0, 1), lambda value: -value, "steps[0].bound",
    ),
    "a term left out": (*of_step(2, "terms", lambda t: t[:3] + t[4:]), "steps[2].bound"),
    "the highest terms left out": (*of_step(2, "terms", lambda t: t[:9]), "steps[2].bound"),
    "A and B exchanged": (
        *of_step(1, "terms", lambda t: [[*term[2:], *term[:2]] for term in t]), "steps[1].bound",
    ),
    "a step left out": (("steps",), lambda steps: [steps[0], steps[2], steps[2]], "steps[1].bound"),
    "steps exchanged": (("steps",), lambda steps: [steps[1], steps[0], steps[2]], "steps[0].bound"),
    "the last step left out": (("steps",), lambda steps: steps[:2], "end_time"),
    "an end that is later": (("end_time",), "4/16", "end_time"),
    "an end in the past": (("end_time",), "-3/16", "end_time"),
    "a bound smaller by a hundredth": (*of_step(0, "bound", lambda b: b * 99 // 100), "steps[0].b"),
    "bounds in other units": (("bound_bits",), 61, "steps[0].bound"),
    "coefficients in other units": (("bits",), 35, "steps[0].bound"),
    "rates in other units": (("rate_bits",), 21, "steps[0].rates"),
    "no growth": (*of_step(0, "rates", lambda rates: [0 for _ in rates]), "steps[0].rates"),
    "one rate in place of several": (*of_step(0, "rates", lambda r: r[:1]), "steps[0].rates"),
    "one rate smaller": (
        *of_step(2, "rates", lambda r: [*r[:2], int(0.95 * r[2]), *r[3:]]), "steps[2].rates",
    ),
    "another coupling": (("epsilon",), "1.0000001", "steps[0].bound"),
    "another detuning": (("omega",), "-4.0000001", "steps[0].bound"),
    "where no norm is kept": (("omega",), "1", "omega: the linear flow keeps no norm"),
    "other data": (DATUM, "1/11", "steps[0].bound"),
    "shorter steps": (("steps_per_tau",), 32, "end_time"),
    "a shorter chain": (("initial",), [["1"], ["0"], ["1/10"], ["0"]], "steps[0].terms[0][0]"),
}  # fmt: skip


@pytest.mark.parametrize("name", PLANTED)
def test_a_planted_error_is_rejected(name, short, verdict):
    place, value, reason = PLANTED[name]
    said = verdict(changed(short, place, value))
    assert said.startswith("no: ") and reason in said, said


def test_the_same_numbers_in_other_words_are_accepted(short, verdict):
    """So that the rejections above are those of the planted errors."""
    same = changed(changed(short, ("omega",), "-4.0"), ("end_time",), "0.1875")
    assert verdict(short) == verdict(same) == "yes\n"


def test_the_bound_of_the_certificate_is_as_small_as_its_digits_allow(committed):
    """What is left out of the coefficients, half a unit each, is some part of the bound."""
    last = committed["steps"][-1]["bound"] / 2**60
    units = 2.0 ** -committed["bits"] * np.sqrt(12) * len(committed["steps"])
    assert 0.1 * units < last < 100 * units
