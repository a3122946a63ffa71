"""The blocks of README and docs/ in the order in which a reader meets them, and how they are run.

A block without a word after its fence holds commands. A block `text` shows what these commands
print; "..." stands where two runs print different words. A block `yaml` or `python` is a file, and
its first line names the file. A block `pycon` is a session of Python. A comment `<!-- fails -->`
above a block says that its commands must fail.
"""

import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import yaml
from helpers import python_path, run_ready
from latticode.configuration.files import merge
from replication.archive.contents import code_files

FENCED = re.compile(r"(?:^<!-- ([\w ]+) -->\n)?^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
SNAKEMAKE = re.compile(r"snakemake( |$)")
FILES = ("yaml", "python")
KINDS = ("", "text", "pycon", *FILES)
BASELINE = "tests/baseline/"
MADE_ONCE = ("reference", "proofs", "speed", "quoted")
"""What of the baseline no acceptance writes."""


class Block(NamedTuple):
    """One fenced block of a page."""

    page: str
    line: int
    kind: str
    mark: str
    text: str

    @property
    def name(self) -> str:
        return f"{self.page}:{self.line}"


class Done(NamedTuple):
    """What became of a block that was run."""

    code: int
    screen: str


def pages(project: Path) -> list[str]:
    """Return README and the pages in the order of its links: a page builds on those before it."""
    linked = re.findall(r"\((docs/\w+\.md)", (project / "README.md").read_text(encoding="utf-8"))
    return ["README.md", *dict.fromkeys(linked)]


def inline_calls(project: Path, page: str) -> list[str]:
    """Return the calls of Snakemake that a sentence or a table names, without the program."""
    text = FENCED.sub("", (project / page).read_text(encoding="utf-8"))
    spans = (" ".join(span.split()) for span in re.findall(r"`([^`]+)`", text))
    calls = (re.fullmatch(r"snakemake (.+)", span) for span in spans)
    return [call[1] for call in calls if call]


def blocks(project: Path, page: str) -> list[Block]:
    """Return the fenced blocks of a page."""
    text = (project / page).read_text(encoding="utf-8")
    return [
        Block(
            page,
            text.count("\n", 0, fence.start(2)) + 1,
            fence[2],
            fence[1] or "",
            fence[3],
        )
        for fence in FENCED.finditer(text)
    ]


def file_of(block: Block) -> str:
    """Return the name of the file that a block is."""
    (name,) = re.findall(r"\A# (\w+\.(?:yaml|py))$", block.text, re.MULTILINE)
    return name


def is_printed(text: str, output: str) -> bool:
    """Return whether the lines of a text stand in what was said, in order; "..." is anything."""
    lines = [" ".join(line.split()) for line in text.splitlines() if line.strip()]
    ways = [re.escape(line).replace(r"\.\.\.", ".*") for line in lines]
    plain_text = "\n".join(" ".join(line.split()) for line in output.splitlines())
    return re.search("(?:.*\n)*?.*".join(ways), plain_text) is not None


def only_targets(block: Block) -> list[str]:
    """Return the targets of a block that is one command and names nothing else."""
    targets = re.fullmatch(r"snakemake((?: [a-z]\w*)+)\n", block.text)
    return targets[1].split() if targets else []


def dry(block: Block) -> Block:
    """Return the block with each call of Snakemake as a dry run."""
    return block._replace(text=re.sub(r"^snakemake(?= |$)", "snakemake -n", block.text, flags=re.M))


def prepare(project: Path, finished: Path, clone: Path) -> None:
    """Make a clone in which the printed commands take seconds.

    It holds what git tracks, the finished quick run as its results, and the quick configuration as
    its own, so that no command has to ask for it. The accepted results, which are those of a full
    run, and the archive are left out: the quick run is to be accepted, and the clone packed. The
    packages are those of the tests.
    """
    for name in code_files(project):
        inside = name.removeprefix(BASELINE)
        if inside == name or inside.split("/")[0] in MADE_ONCE:
            (clone / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(project / name, clone / name)
    for words in (["init", "--quiet"], ["add", "--all"]):
        subprocess.run(["git", "-C", str(clone), *words], check=True)
    for folder in ("results", ".snakemake"):
        left = shutil.ignore_patterns("archive")
        shutil.copytree(finished / folder, clone / folder, ignore=left)
    quick = yaml.safe_load((clone / "config/quick.yaml").read_text())
    for path in {*clone.glob("config/*.yaml")} - {clone / "config/quick.yaml"}:
        settings = yaml.safe_load(path.read_text())
        merged = merge(settings, {key: quick[key] for key in settings.keys() & quick.keys()})
        path.write_text(yaml.safe_dump(merged, sort_keys=False))


class Reader:
    """Gives the commands of pages, and stays in the folder to which a page has led."""

    def __init__(self, clone: Path):
        self.clone, self.folder, self.page = clone, clone, ""
        self.beside = clone.parent
        self.path = f"{Path(sys.executable).parent}:{os.environ['PATH']}"  # where `python3` is ours

    def play(self, block: Block) -> Done:
        """Run a block as it is printed. Every page starts in the folder of the clone."""
        if block.page != self.page:
            self.page, self.folder = block.page, self.clone
        if block.kind in FILES:
            (self.folder / file_of(block)).write_text(block.text, encoding="utf-8")
            return Done(0, "")
        if block.kind == "pycon":
            (self.beside / "session.txt").write_text(block.text, encoding="utf-8")
            words = ["doctest", "-o", "NORMALIZE_WHITESPACE", str(self.beside / "session.txt")]
            return self._ready(words, PYTHONPATH=python_path(self.clone))
        output = ""
        for line in block.text.splitlines():
            if SNAKEMAKE.match(line):
                done = self._ready(shlex.split(line), **self._environment())
            else:
                done = self._shell(line)
            output += done.screen
            if done.code:
                break
        return Done(done.code, output)

    def _environment(self) -> dict[str, str]:
        """Return the variables of a reader who has installed the copy in whose folder he is."""
        folders = (self.folder, *self.folder.parents)
        project = next(
            (folder for folder in folders if (folder / "Snakefile").exists()), self.clone
        )
        return {"PATH": self.path, "PYTHONPATH": python_path(project)}

    def _ready(self, words: list[str], **variables: str) -> Done:
        """Run a module where its imports are done: they are nearly half of most commands."""
        done = run_ready(["python", "-m", *words], self.folder, **variables)
        return Done(done.returncode, done.stdout + done.stderr)

    def _shell(self, line: str) -> Done:
        """Run a line in a shell, and stay in the folder to which it leads."""
        reached = self.beside / "folder.txt"
        run = subprocess.run(
            ["bash", "-euo", "pipefail", "-c", f"{line}\npwd > {shlex.quote(str(reached))}"],
            cwd=self.folder,
            env={**os.environ, **self._environment()},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        if not run.returncode:
            self.folder = Path(reached.read_text().rstrip("\n"))
        return Done(run.returncode, run.stdout)
