"""What a person is told of targets: their list, a misspelt one, how long a job takes, the end.

`snakemake --list` shows every rule in one row, also those with wildcards, which nobody can call by
name. `list_targets` is put in its place: the targets that can be called, in groups. Of a target
that nothing makes, Snakemake says that an input function may have failed; `faults_of_targets` names
the nearest targets.
"""

import difflib
import json
import os
import sys
from argparse import Namespace
from collections.abc import Iterable, Mapping
from pathlib import Path

from job import SPENT, TOOK
from snakemake.cli import get_argument_parser

WHOLE, FIGURES, STUDIES = "Everything, and parts of it", "Figures", "Cases, sweeps and studies"
CHECKS, OWN = "Checks, claims and tables", "Your own cases and sweeps"
UPKEEP = "Baseline, speed, references and archive"
GROUPS = (WHOLE, FIGURES, STUDIES, CHECKS, OWN, UPKEEP)

BY_FILE = {
    "own": OWN,
    **dict.fromkeys(("archive", "benchmarks", "figure_diff", "reference"), UPKEEP),
}
"""The group of all targets in a file of rules. The others go by what they make below results/."""

BY_WHAT_IS_MADE = {
    FIGURES: {"figures"},
    STUDIES: {"trajectories", "sweeps", "breathers", "pendula", "unbounded", "certified"},
    CHECKS: {"checks", "tables", "claims.json", "controls.json"},
}

PAGES = ("results/figure_diff/index.html", "results/own_report.html", "results/report.html")
"""What to look at first, where a run made it."""

FEW = 4
"""So many files are named one by one; of more, their folders are."""

ACCEPTED = Path(__file__).parents[1] / "tests/baseline/quoted/reproduction.json"
"""Where the time of an accepted full run went; see benchmarks/reproduction.py."""


def list_targets(rules) -> str:
    """Return a line for each target that can be called by name, below its group."""
    callable_ones = [rule for rule in rules if not rule.has_wildcards()]
    width = max(len(rule.name) for rule in callable_ones)
    lines = []
    for group in GROUPS:
        members = sorted((r for r in callable_ones if group_of(r) == group), key=lambda r: r.name)
        lines += [group, *(f"  {r.name:{width}}  {r.docstring}" for r in members), ""]
    return "\n".join([*lines, "Any file can be asked for too: snakemake results/figures/fig2.pdf"])


def group_of(rule) -> str:
    """Return the group that a target is listed in."""
    if group := BY_FILE.get(Path(rule.snakefile).stem):
        return group
    made = {Path(str(path)).parts[1] for path in (rule.output or rule.input)}
    return next((group for group, folders in BY_WHAT_IS_MADE.items() if made <= folders), WHOLE)


def asked() -> list[str]:
    """Return the targets of the command line, as Snakemake itself reads them from it."""
    return getattr(_command_line(), "targets", [])


def _command_line() -> Namespace | None:
    """Return what Snakemake was called with: while it reads the Snakefile, it hands on nothing."""
    started = Path(sys.argv[0]).name in ("snakemake", "__main__.py")
    return get_argument_parser().parse_args(sys.argv[1:]) if started else None


def _from_outside(path: str) -> str:
    """Return a path as the user types it, who may have called Snakemake with `--directory`."""
    return os.path.join(getattr(_command_line(), "directory", None) or "", path)


def faults_of_targets(words: Iterable[str], rules: Iterable, own: Iterable[str]) -> list[str]:
    """Return a sentence on each word that is no target; `own` are a user's cases and sweeps."""
    named = {rule.name: rule for rule in rules}
    return [fault for word in words if (fault := _fault_of_target(word, named, own))]


def _fault_of_target(word: str, rules: Mapping, own: Iterable[str]) -> str | None:
    patterns = {name: rule for name, rule in rules.items() if rule.has_wildcards()}
    if word in patterns:
        text = "makes more than one file: name the file that you want, and not the rule"
        return f"{word} {text}. {patterns[word].docstring}"
    path = word if os.path.isabs(word) else os.path.relpath(word)
    if word in rules or any(rule.is_producer(path) for rule in rules.values()):
        return None
    if "/" in word and os.path.exists(path):
        return None
    if word in own:
        return (
            f"there is no target {word}: it is a case or a sweep of your own, and the target own "
            "makes the figures, the checks and the report of all of them"
        )
    callable_ones = rules.keys() - patterns.keys()
    if "/" in word:
        parts = [rules[name] for name in callable_ones]
        files = {f for rule in parts for f in [*rule.output, *rule.input] if isinstance(f, str)}
        text = "A file of a case of your own needs its --configfile"
        return f"nothing makes the file {word}{_nearest(path, files, 0.8)} {text}"
    nearest = _nearest(word, callable_ones, 0.5)
    return f"there is no target {word}{nearest} `snakemake --list` shows all"


def _nearest(word: str, known: Iterable[str], likeness: float) -> str:
    near = difflib.get_close_matches(word, sorted(known), 3, likeness)
    return f"; did you mean {' or '.join(near)}?" if near else "."


def accepted_seconds() -> dict[str, float]:
    """Return the wall time of each job of the accepted full run, by its log, if it is there."""
    if not ACCEPTED.exists():
        return {}
    runs = json.loads(ACCEPTED.read_text(encoding="utf-8"))["runs"]
    return {k: told["wall"] for k, told in runs["warm"]["jobs"].items() if "wall" in told}


def seconds_of(log: str, accepted: Mapping[str, float]) -> float | None:
    """Return the wall time of a job as its log, or else the accepted run, tells it."""
    last = _lines(log)[-1:]
    if last and last[0].startswith(TOOK):
        return float(last[0].removeprefix(TOOK).split()[0])
    return accepted.get(log.removeprefix("results/logs/").removesuffix(".log"))


def _lines(log: str) -> list[str]:
    path = Path(log)
    return path.read_text(encoding="utf-8", errors="replace").splitlines() if path.exists() else []


def where_to_look(targets: Iterable) -> str:
    """Return what a finished run tells last; `targets` are its target jobs."""
    made = [str(path) for job in targets for path in (job.output or job.input)]
    for page in PAGES:
        if page in made:
            return f"Done. Open {_from_outside(page)} in a browser."
    shown = sorted(path for path in made if path.endswith(".png")) or sorted(made)
    if len(shown) > FEW:
        shown = sorted({f"{Path(path).parent}/" for path in shown})
    return f"Done. Look at {', '.join(map(_from_outside, shown))}." if shown else "Done."


def what_failed(jobs: Iterable) -> str:
    """Return what a failed run tells last: of each job what it did, its log and the cause in it."""
    lines = []
    for job in sorted(jobs, key=str):
        logs = ", ".join(map(_from_outside, job.log)) or "above"
        lines.append(f"  {job.message or job.rule.name}: see {logs}")
        lines += [f"    {line}" for log in job.log for line in _cause(log)]
    if not lines:
        return "Stopped. The same command goes on from here."
    kept = "What the other jobs made is kept. Once the cause is mended, the same command goes on."
    return "\n".join(["Failed:", *lines, kept])


def _cause(log: str) -> list[str]:
    """Return what a log says; where a traceback ends it, the message right above that."""
    lines = [
        line for line in _lines(log) if line and not line.startswith((SPENT, TOOK, "(the log has"))
    ]
    start = next((i for i, line in enumerate(lines) if line.startswith("Traceback")), None)
    return lines if start is None else lines[:start][-2:]
