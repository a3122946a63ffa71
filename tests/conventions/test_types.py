"""The public faces of both packages, by a type checker: what a user's editor tells of a call."""

import os
import subprocess
import sys
from importlib.util import find_spec

import pytest
from helpers import ROOT, skip

FACES = [
    "packages/latticode/latticode/__init__.py",
    "packages/latticode/latticode/notebook.py",
    "packages/latticode/latticode/configuration/keys.py",
    "scripts/pendula/__init__.py",
    "scripts/pendula/notebook.py",
]
MODEL = """from latticode import Case, Model, draw_norms, lap, simulate
model = Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u))
case = Case(model=model, initial={0: [1]})
"""
WRONG = {
    "Case(modell=model, initial={0: [1]})": 'Unexpected keyword argument "modell" for "Case"',
    "Case(model=model)": 'Missing named argument "initial"',
    "case.changed(end_tim=4)": 'Unexpected keyword argument "end_tim" for "changed" of "Case"',
    "import latticode; latticode.simulat": 'Module has no attribute "simulat"',
    "simulate(3)": 'Argument 1 to "simulate" has incompatible type "int"',
    "draw_norms(simulate(case)).savfig('a')": '"Figure" has no attribute "savfig"',
    "import pendula; pendula.Case(omgea=8)": 'Unexpected keyword argument "omgea" for "Case"',
}


def check_types(*files):
    """Return what mypy says of files."""
    if find_spec("mypy") is None:
        skip("mypy is not installed", "pip install -r tests/conventions/requirements.txt")
    paths = os.pathsep.join(str(ROOT / folder) for folder in ("packages/latticode", "scripts"))
    command = [sys.executable, "-m", "mypy", "--follow-imports=silent", *map(str, files)]
    environment = {**os.environ, "MYPYPATH": paths}
    return subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True).stdout


def test_the_public_faces_are_clean():
    assert check_types(*FACES).startswith("Success")


@pytest.fixture(scope="module")
def messages(tmp_path_factory):
    path = tmp_path_factory.mktemp("types") / "wrong.py"
    path.write_text("\n".join([MODEL, *WRONG]))
    return check_types(path)


@pytest.mark.parametrize(("call", "words"), WRONG.items(), ids=WRONG)
def test_a_wrong_call_is_found_before_it_runs(call, words, messages):
    number = "\n".join([MODEL, *WRONG]).split("\n").index(call) + 1
    line = f"wrong.py:{number}: error: "
    assert any(line in each and words in each for each in messages.splitlines()), messages
