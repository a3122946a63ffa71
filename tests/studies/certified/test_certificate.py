"""The committed certificate, its checker, and planted errors that the checker must refuse."""

import ast
import copy
import json
import subprocess
import sys

import numpy as np
import pytest
import yaml
from certified.check_certificate import check
from helpers import ROOT
from pendula.configuration.messages import STUDIES, load
from pendula.problem import Problem
from pendula.studies.certified.certificate import make_certificate

CHECKER = ROOT / "scripts/certified/check_certificate.py"
COMMITTED = ROOT / "tests/baseline/proofs/short_case.json"


@pytest.fixture(scope="module")
def committed():
    return json.loads(COMMITTED.read_text())


def test_a_stranger_needs_nothing_but_python(tmp_path):
    code = CHECKER.read_text()
    assert len(code.splitlines()) <= 150
    imports = [n for n in ast.walk(ast.parse(code)) if isinstance(n, ast.Import | ast.ImportFrom)]
    named = {
        (node.module if isinstance(node, ast.ImportFrom) else node.names[0].name)
        for node in imports
    }
    assert named == {"json", "sys", "fractions", "math", "operator"}
    told = subprocess.run(
        [sys.executable, "-I", CHECKER, COMMITTED], capture_output=True, text=True, cwd=tmp_path
    )
    assert (told.returncode, told.stdout) == (0, "yes\n")


def test_the_committed_certificate_is_what_the_library_makes(committed):
    files = [ROOT / f"config/{name}.yaml" for name in ("config", *STUDIES)]
    raw = {k: v for file in files for k, v in yaml.safe_load(file.read_text()).items()}
    settings = load(raw)
    given = settings.certified.certificate
    short = {"half_width": given.half_width, "end_time": given.end_time}
    assert make_certificate(Problem.of({**settings.problem(given.case), **short})) == committed


def of_step(number, **changes):
    def change(certificate):
        step = certificate["steps"][number]
        for name, how in changes.items():
            step[name] = how(step[name])

    return change


def term(number, order, row, site, by=1):
    def change(certificate):
        certificate["steps"][number]["terms"][order][row][site] += by

    return change


def without(number, shorter):
    def change(certificate):
        del certificate["steps"][number]
        if shorter:
            certificate["end_time"] = "1/8"

    return change


def backwards(certificate):
    certificate.update(steps_per_tau=-certificate["steps_per_tau"], end_time="-3/16")


def constant(name, text):
    return lambda certificate: certificate.update({name: text})


PLANTED = {  # in the first three steps
    "the last digit of data": (term(0, 0, 0, 1), "bound"),
    "the last digit of a slope": (term(0, 1, 1, 1), "bound"),
    "the last digit of a late coefficient": (term(1, 3, 0, 1), "bound"),
    "the last digits of the highest term": (term(1, 14, 3, 2, 99), "bound"),
    "a step left out": (without(1, shorter=True), "bound"),
    "the last step left out": (without(2, shorter=False), "end"),
    "a bound smaller by a hundredth": (of_step(0, bound=lambda b: b * 99 // 100), "bound"),
    "the last bound smaller": (of_step(2, bound=lambda b: b * 99 // 100), "bound"),
    "no growth": (of_step(0, rates=lambda rates: [0 for _ in rates]), "rate"),
    "one rate smaller": (of_step(2, rates=lambda r: [*r[:2], int(0.95 * r[2]), *r[3:]]), "rate"),
    "no rates": (of_step(1, rates=lambda rates: []), "rate"),
    "steps back in time": (backwards, "end"),
    "another drive": (constant("gamma", "1.0000001"), "bound"),
    "another detuning": (constant("omega", "-4.0000001"), "bound"),
    "where no norm is kept": (constant("omega", "1"), "norm"),
    "other data": (constant("initial", [["0", "1", "0"], *3 * [3 * ["0"]]]), "bound"),
}


@pytest.fixture(scope="module")
def short(committed):
    """Return the certificate of the first three steps, which holds too."""
    certificate = committed | {"steps": committed["steps"][:3], "end_time": "3/16"}
    assert check(certificate) == ""
    return certificate


@pytest.mark.parametrize("name", PLANTED)
def test_a_planted_error_is_refused(name, short):
    plant, reason = PLANTED[name]
    changed = copy.deepcopy(short)
    plant(changed)
    assert reason in check(changed)


def test_the_bound_of_the_certificate_is_as_small_as_its_digits_allow(committed):
    """What is left out of the coefficients, half a unit each, is some part of the bound."""
    last = committed["steps"][-1]["bound"] / 2**60
    units = 2.0 ** -committed["bits"] * np.sqrt(12) * len(committed["steps"])
    assert 0.1 * units < last < 100 * units
