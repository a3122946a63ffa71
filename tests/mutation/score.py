"""How many faults the tests notice: the share of mutants of decisive modules that they kill.

Run as `python tests/mutation/score.py --sample 300` in an environment that holds requirements.txt
of this folder besides the project's own packages. Cosmic Ray makes the mutants: it changes one
sign, operator, number, comparison, condition or loop. A random sample of all mutants of the modules
in decisive.yaml meets the tests that stand there. A mutant survives if all of these pass; one that
takes far longer than the code itself is ended and counts as killed. Mutants that equivalent.yaml
lists change no result, and do not count. Nothing changes in the project: all happens in a copy.

With --keep the score goes to tests/baseline/quoted/mutation.json, from which docs/ quote it. With
--folder a folder keeps kernels, times of tests and outcomes, and a later run does not repeat them.
An outcome is that of one text of the module and of its tests: if either changes, the mutant is
tried again. A change elsewhere in the library asks for a new folder.
"""

import argparse
import hashlib
import json
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import yaml
from cosmic_ray.ast import Visitor, get_ast
from cosmic_ray.mutating import mutate_code
from cosmic_ray.plugins import get_operator
from trial import ENDED, ROOT, SURVIVED, Trial

HERE = Path(__file__).parent
KEPT = ROOT / "tests/baseline/quoted/mutation.json"
CONFIDENCE = 0.95

REPLACED = {
    "BinaryOperator": "Add_Sub Sub_Add Mul_Div Div_Mul FloorDiv_Mul Mod_Sub Pow_Mul",
    "ComparisonOperator": "Lt_LtE LtE_Lt Gt_GtE GtE_Gt Lt_Gt LtE_GtE Gt_Lt GtE_LtE "
    "Eq_NotEq NotEq_Eq",
    "UnaryOperator": "Delete_USub Delete_Not",
}
OPERATORS = [f"Replace{kind}_{pair}" for kind, pairs in REPLACED.items() for pair in pairs.split()]
OPERATORS += ["ReplaceAndWithOr", "ReplaceOrWithAnd", "ReplaceTrueWithFalse"]
OPERATORS += ["ReplaceFalseWithTrue", "ReplaceBreakWithContinue", "ReplaceContinueWithBreak"]
OPERATORS += ["AddNot", "ZeroIterationForLoop", "NumberReplacer"]
"""Operators whose mutants still compute: a mutant with << in place of + fails at once."""


class Place(NamedTuple):
    """Where a mutant is made: the module, the operator, and which of its places there."""

    module: str
    operator: str
    occurrence: int


class _Places(Visitor):
    """Counts the places of an operator in a tree."""

    def __init__(self, operator):
        self.operator, self.count = operator, 0

    def visit(self, node):
        self.count += sum(1 for _ in self.operator.mutation_positions(node))
        return node


def places_in(module: str, text: str) -> Iterator[Place]:
    """Yield all places of a module at which a mutant can be made."""
    tree = get_ast(text)
    for operator in OPERATORS:
        places = _Places(get_operator(f"core/{operator}")())
        places.walk(tree)
        yield from (Place(module, operator, number) for number in range(places.count))


def mutate(place: Place, text: str) -> tuple[str, dict[str, str]]:
    """Return a mutant of a module's text, and what it is: the line as it was, and as it is now."""
    changed = mutate_code(text, get_operator(f"core/{place.operator}")(), place.occurrence)
    lines = zip(text.splitlines(), changed.splitlines(), strict=True)
    before, after = next((old, new) for old, new in lines if old != new)
    return changed, {"module": place.module, "before": squeezed(before), "after": squeezed(after)}


def drawn_number(seed: int, place: Place) -> str:
    """Return a random number by which mutants are ordered: the sample is those that come first.

    Each place has its own, so that most of a sample stays the same when a module changes.
    """
    return hashlib.sha256(f"{seed} {place}".encode()).hexdigest()


def squeezed(line: str) -> str:
    """Return a line of code with its comment and all but single blanks left out."""
    return " ".join(line.split("  #")[0].split())


def is_equivalent(mutant: dict[str, str], listed: dict[str, list]) -> bool:
    """Return whether equivalent.yaml lists a mutant, by its line or by a part of it.

    `anywhere: [old, new]` stands for all lines in which `new` takes the place of one `old`.
    """
    before, after = mutant["before"], mutant["after"]
    for one in listed.get(mutant["module"], ()):
        if "anywhere" in one:
            old, new = one["anywhere"]
            places = (i for i in range(len(before)) if before.startswith(old, i))
            if any(before[:i] + new + before[i + len(old) :] == after for i in places):
                return True
        elif (one["before"], one["after"]) == (before, after):
            return True
    return False


def outcomes(
    trial: Trial, places: list[Place], texts: dict[str, str], tests: dict[str, list], log: Path
) -> list[dict]:
    """Return the outcome of each mutant that is not equivalent; stop early at Ctrl-C."""
    done = [json.loads(line) for line in log.read_text().splitlines()] if log.exists() else []
    known = {one["digest"]: one["outcome"] for one in done}
    found = []
    ignored = yaml.safe_load((HERE / "equivalent.yaml").read_text(encoding="utf-8"))
    try:
        for place in places:
            text, mutant = mutate(place, texts[place.module])
            if is_equivalent(mutant, ignored):
                continue
            digest = trial.digest(text, tests[place.module])
            outcome = known.get(digest)
            if outcome is None:
                outcome = trial.outcome(place.module, text, tests[place.module])
                with open(log, "a", encoding="utf-8") as kept:
                    print(json.dumps({**mutant, "outcome": outcome, "digest": digest}), file=kept)
            found.append({**mutant, "outcome": outcome})
            survived = sum(one["outcome"] == SURVIVED for one in found)
            print(f"{len(found)} mutants, {survived} survived", end="\r", flush=True)
    except KeyboardInterrupt:
        print("stopped early, the score is that of a smaller sample")
    return found


def summary(found: list[dict], total: int, seed: int, modules: int) -> dict:
    """Return the score with its exact limits, and the survivors."""
    sys.path.insert(0, str(ROOT / "scripts"))
    from pendula.measures.confidence import (
        share_limits,
    )  # a mutant must not meet it in this process

    noticed = sum(one["outcome"] != SURVIVED for one in found)
    limits = share_limits(noticed, len(found), CONFIDENCE)
    return {
        "modules": modules,
        "mutants": total,
        "seed": seed,
        "sample": len(found),
        "killed": noticed,
        "ended": sum(one["outcome"] == ENDED for one in found),
        "confidence": CONFIDENCE,
        "score": limits.value,
        "low": limits.low,
        "high": limits.high,
        "survivors": [
            {key: one[key] for key in ("module", "before", "after")}
            for one in found
            if one["outcome"] == SURVIVED
        ],
    }


def main() -> None:
    """Sample mutants, try them, and print the score and the survivors."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("modules", nargs="*", help="modules of decisive.yaml, by default all")
    parser.add_argument("--sample", type=int, default=300, help="mutants to try at most")
    parser.add_argument("--seed", type=int, default=2017)
    parser.add_argument("--folder", type=Path, help="folder to go on from, or to begin")
    parser.add_argument(
        "--plain", action="store_true", help="leave compiled tests out: a lower bound, much sooner"
    )
    parser.add_argument("--keep", action="store_true", help="replace the score that docs/ quote")
    given = parser.parse_args()
    tests = yaml.safe_load((HERE / "decisive.yaml").read_text(encoding="utf-8"))
    with tempfile.TemporaryDirectory() as folder:
        trial = Trial(given.folder or Path(folder), not given.plain)
        texts = {module: trial.text_of(module) for module in given.modules or tests}
        places = [place for module, text in texts.items() for place in places_in(module, text)]
        drawn = sorted(places, key=lambda place: drawn_number(given.seed, place))
        log = trial.folder / "outcomes.jsonl"
        found = outcomes(trial, drawn[: given.sample], texts, tests, log)
    score = {"plain": given.plain, **summary(found, len(places), given.seed, len(texts))}
    text = json.dumps(score, indent=1, ensure_ascii=False) + "\n"
    print(f"\n{text}")
    if given.keep:
        KEPT.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
