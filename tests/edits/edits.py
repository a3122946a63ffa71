"""Run the small full run with the paper's cases changed: every key of every case, in three ways.

    PYTHONPATH=scripts python tests/edits/edits.py [case ...] [key ...]

Each run must end well and say nothing false, or a sentence must refuse it before any job starts.
edits.yaml has the values. One run changes one key of each case; only where that fails do its
edits run singly, to tell which it was. It takes half an hour, so it is a part of .ci/elsewhere.
"""

import re
import shutil
import subprocess
import sys
from itertools import zip_longest
from pathlib import Path
from tempfile import TemporaryDirectory

import yaml
from false_sentences import false_sentences
from latticode.configuration.files import ConfigurationError, gather
from latticode.configuration.messages import SOLVERS
from pendula.configuration.messages import STUDIES, load, require
from pendula.configuration.schema import PAPER_CASES, PAPER_SWEEPS

ROOT = Path(__file__).resolve().parents[2]
QUICK = ROOT / "config/quick.yaml"
EDITS = yaml.safe_load(Path(__file__).with_suffix(".yaml").read_text())
HANGS = 900
"""Seconds after which a run hangs: a small full run takes a minute."""


def refused(edits: dict[str, dict]) -> str:
    """Return the sentence that refuses these keys of cases, or nothing."""
    files = [ROOT / f"config/{name}.yaml" for name in ("config", *STUDIES)]
    solvers = [name for name in SOLVERS if name != "kahan_li"]  # by which no case of the paper runs
    try:
        settings = load(gather([*files, QUICK], {"cases": edits}))
        require(settings, PAPER_CASES, PAPER_SWEEPS, solvers)
    except ConfigurationError as error:
        return " ".join(str(error).split())
    return ""


def fault(finished: Path, edits: dict[str, dict]) -> str:
    """Return what is wrong with a run that continues a copy of a finished one, or nothing."""
    with TemporaryDirectory() as temporary:
        folder = Path(shutil.copytree(finished, Path(temporary) / "run"))
        (edited := folder / "edited.yaml").write_text(yaml.safe_dump({"cases": edits}))
        try:
            ended = run(folder, edited)
        except subprocess.TimeoutExpired:
            return f"it did not end in {HANGS} s"
        if ended.returncode:
            screen = ended.stdout + ended.stderr
            return ", ".join(sorted(set(re.findall(r"Error in rule (.*):", screen)))) or screen
        return "; ".join(false_sentences(folder))


def run(folder: Path, *files: Path) -> subprocess.CompletedProcess:
    """Make the small full run in `folder`, with more configuration files."""
    words = ["--snakefile", ROOT / "Snakefile", "--directory", folder, "--configfile", QUICK]
    command = [sys.executable, "-m", "snakemake", *map(str, [*words, *files])]
    return subprocess.run(command, capture_output=True, text=True, timeout=HANGS, check=False)


def combined(tried: dict[str, list[dict]]):
    """Yield one edit of each case at a time, of unlike keys, until each edit had its turn."""
    turned = []
    for number, edits in enumerate(tried.values()):
        first = number * len(edits) // len(tried)
        turned.append(edits[first:] + edits[:first])
    for together in zip_longest(*turned):
        yield {case: edit for case, edit in zip(tried, together, strict=True) if edit}


def main(*names: str) -> int:
    """Print a line for each run and for each refused edit; return how many edits failed."""
    if unknown := set(names) - {*PAPER_CASES, *EDITS}:
        sys.exit(f"{', '.join(sorted(unknown))}: no case of the paper, and no key of a case")
    cases = [name for name in PAPER_CASES if name in names] or PAPER_CASES
    keys = [name for name in EDITS if name in names] or EDITS
    tried = {case: [] for case in cases}
    for case in cases:
        for edit in ({key: value} for key in keys for value in EDITS[key]):
            if why := refused({case: edit}):
                print(f"refused: {why}")
            else:
                tried[case].append(edit)
    failed = 0
    with TemporaryDirectory() as temporary:
        finished = Path(temporary) / "finished"
        run(finished).check_returncode()
        for edits in combined(tried):
            rules = fault(finished, edits)
            print(f"{'FAILED' if rules else 'ends well'}: {edits} {rules}", flush=True)
            for case, edit in edits.items() if rules else ():
                alone = fault(finished, {case: edit})
                failed += bool(alone)
                print(f"  alone {'FAILED' if alone else 'ends well'}: {case} {edit} {alone}")
    print(f"{failed} edits failed")
    return failed


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]) > 0)
