"""Run the small full run with one key of one of the paper's cases changed, for every key and case.

    python tests/edits.py [case ...] [key ...]

Each run must end well, or a sentence must refuse it before any job starts. tests/edits.yaml has the
values. It takes hours, so it is a part of .ci/elsewhere, and names of cases and keys choose a part.
"""

import re
import shutil
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import yaml

ROOT = Path(__file__).resolve().parents[1]
CASES = [f"fig{n}_{size}" for n in (2, 3, 4) for size in ("small", "large")]
EDITS = yaml.safe_load((ROOT / "tests/edits.yaml").read_text())
HANGS = 900
"""Seconds after which a run hangs: a small full run takes a minute."""


def run(folder: Path, *files: Path) -> subprocess.CompletedProcess:
    """Make the small full run in `folder`, with more configuration files."""
    words = ["--snakefile", ROOT / "Snakefile", "--directory", folder]
    words += ["--configfile", ROOT / "config/quick.yaml", *files]
    command = [sys.executable, "-m", "snakemake", *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, timeout=HANGS, check=False)


def outcome(finished: Path, case: str, key: str, value) -> str:
    """Return how a run ends that continues a copy of a finished one with an edited case."""
    with TemporaryDirectory() as beside:
        folder = Path(shutil.copytree(finished, Path(beside) / "run"))
        (edit := folder / "edit.yaml").write_text(yaml.safe_dump({"cases": {case: {key: value}}}))
        try:
            ended = run(folder, edit)
        except subprocess.TimeoutExpired:
            return f"FAILED: it did not end in {HANGS} s"
    said = ended.stdout + ended.stderr
    if ended.returncode == 0:
        return "ends well"
    refusal = re.search(r"the configuration has \d+ faults?:\n((?:  .*\n)+)", said)
    if refusal and "Job stats:" not in said and "Traceback" not in said:
        return f"refused: {'; '.join(line.strip() for line in refusal[1].splitlines())}"
    return f"FAILED: {', '.join(sorted(set(re.findall(r'Error in rule (.*):', said)))) or said}"


def main(*names: str) -> int:
    """Print a row for each edit; return how many failed."""
    if unknown := set(names) - {*CASES, *EDITS}:
        sys.exit(f"{', '.join(sorted(unknown))}: no case of the paper, and no key of a case")
    failed = 0
    with TemporaryDirectory() as beside:
        finished = Path(beside) / "finished"
        run(finished).check_returncode()
        for case in [name for name in CASES if name in names] or CASES:
            for key in [name for name in EDITS if name in names] or EDITS:
                for value in EDITS[key]:
                    found = outcome(finished, case, key, value)
                    failed += found.startswith("FAILED")
                    print(f"{case} | {key}: {value} | {found}", flush=True)
    print(f"{failed} edits failed")
    return failed


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]) > 0)
