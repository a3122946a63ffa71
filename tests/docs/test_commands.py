"""Each command of README and docs/ is run as it is printed, and prints what the page shows.

All pages are played once, in one clone, in the order of the README's links. `not_run.yaml` lists
the blocks that are dry runs every day, which miss no target, option, file or key, or are not run.
With PENDULA_AS_PRINTED those that can be are run as they are printed (`.ci/elsewhere commands`).
"""

import json
import os
import re
import shutil
from importlib.util import find_spec
from itertools import pairwise
from pathlib import Path

import pytest
import yaml
from helpers import MY_BASELINE, ROOT, snakemake
from latticode.configuration.files import ConfigurationError, gather
from pendula.configuration.messages import STUDIES, load
from printed import (
    FILES,
    KINDS,
    Block,
    Done,
    Reader,
    blocks,
    dry,
    inline_calls,
    is_printed,
    only_targets,
    pages,
    prepare,
)

PAGES = pages(ROOT)
PRINTED = {page: blocks(ROOT, page) for page in PAGES}
ALL = [block for page_blocks in PRINTED.values() for block in page_blocks]
NOT_RUN = yaml.safe_load((Path(__file__).parent / "not_run.yaml").read_text(encoding="utf-8"))
AS_PRINTED = bool(os.environ.get("PENDULA_AS_PRINTED"))


def first(block: Block) -> tuple[str, str]:
    return block.page, block.text.splitlines()[0]


def listed(*days: str) -> set[tuple[str, str]]:
    """Return the blocks of not_run.yaml that are run every day in one of these ways."""
    return {(page, line) for day in days for page in NOT_RUN[day] for line in NOT_RUN[day][page]}


LEFT_OUT = listed("never") if AS_PRINTED else listed("never", "nothing")
DRY = set() if AS_PRINTED else listed("dry run")
INLINE = [call for page in PAGES for call in inline_calls(ROOT, page)]
RUN = [block for block in ALL if block.kind in ("", "pycon") and first(block) not in LEFT_OUT]
JOINED = [block for block in RUN if first(block) in DRY and only_targets(block)]
BY_TARGETS = {call for call in INLINE if re.fullmatch(r"[a-z]\w*( [a-z]\w*)*", call)}
TARGETS = [*sorted(BY_TARGETS), *(target for block in JOINED for target in only_targets(block))]
IN_BLOCKS = {line.removeprefix("snakemake ") for block in RUN for line in block.text.splitlines()}
CALLS = [" ".join(TARGETS), *sorted({*INLINE} - BY_TARGETS - IN_BLOCKS)]
ASKED = [Block(call, 0, "", "", f"snakemake -n {call}") for call in CALLS]
"""What sentences and tables say to ask Snakemake for. One dry run does for all targets that are
named alone, those of blocks too."""
PLAYED = {block: dry(block) if first(block) in DRY else block for block in RUN}


OWN_CASES = re.compile(r"snakemake own --configfile (\w+\.yaml)\n")


def play(reader: Reader, block: Block) -> Done:
    """Play a block; of a user's own cases that another test runs, read the configuration alone."""
    if first(block) not in DRY or not (options := OWN_CASES.fullmatch(block.text)):
        return reader.play(PLAYED.get(block, block))
    files = [ROOT / f"config/{name}.yaml" for name in ("config", *STUDIES)]
    try:
        load(gather([*files, reader.clone / options[1]], {}))
    except ConfigurationError as error:
        return Done(1, str(error))
    return Done(0, "")


def accept_and_pack(clone: Path, full_run: Path) -> None:
    """Put into the clone what the blocks make that are dry runs and what others begin with."""
    shutil.copytree(full_run / MY_BASELINE, clone / "tests/baseline", dirs_exist_ok=True)
    shutil.copytree(full_run / "results/archive", clone / "results/archive")


@pytest.fixture(scope="module")
def playground(made_once, full_run) -> Path:
    """Return a folder with the clone in which all pages were played, and played.json."""

    def make(folder):
        clone = folder / "project"
        prepare(ROOT, full_run, clone)
        if AS_PRINTED:
            accepted = snakemake(clone, clone, "accept_figures")
            assert accepted.returncode == 0, accepted.stderr
        else:
            accept_and_pack(clone, full_run)
        tried = [block for block in ALL if block in RUN or block.kind in FILES]
        reader = Reader(clone)
        run = {block.name: play(reader, block) for block in [*tried, *ASKED] if block not in JOINED}
        run |= {block.name: run[ASKED[0].name] for block in JOINED}
        (folder / "played.json").write_text(json.dumps(run))

    return made_once("printed", make)


@pytest.fixture(scope="module")
def played(playground) -> dict[str, Done]:
    """Return what became of each block, by its name."""
    outputs = json.loads((playground / "played.json").read_text())
    return {name: Done(*done) for name, done in outputs.items()}


def test_lost_figures_are_drawn_from_the_deposited_datasets_alone(playground, full_run):
    """A block of docs/archive.md deletes those of Fig 5 and draws them in an unpacked archive."""
    drawn = list(playground.glob("project/results/archive/*/results/figures/fig5.*"))
    assert len(drawn) == 4
    for path in drawn:
        assert path.read_bytes() == (full_run / "results/figures" / path.name).read_bytes(), path


@pytest.mark.parametrize("block", RUN, ids=lambda block: block.name)
def test_what_is_printed_runs(played, block):
    code, output = played[block.name]
    assert (code != 0) == (block.mark == "fails"), f"{block.text}\n{output}"
    assert "Traceback (most recent call last)" not in output


@pytest.mark.parametrize("block", ASKED, ids=lambda block: block.page)
def test_what_a_sentence_or_a_table_names_can_be_asked_for(played, block):
    assert len(TARGETS) > 10 and played[block.name].code == 0, played[block.name].screen


OUTPUTS = [
    (before, block)
    for page_blocks in PRINTED.values()
    for before, block in pairwise(page_blocks)
    if block.kind == "text"
]


PRINTED_OUTPUTS = [pair for pair in OUTPUTS if first(pair[0]) not in DRY]
"""What a dry run does not say is looked at elsewhere."""


@pytest.mark.parametrize("pair", PRINTED_OUTPUTS, ids=lambda pair: pair[1].name)
def test_what_a_page_shows_is_what_its_command_prints(played, pair):
    command, output = pair
    printed = played[command.name].screen
    assert is_printed(output.text, printed), f"{output.text}\nis not in\n{printed}"
    assert not is_printed(output.text, "something else")


def test_every_block_is_of_a_kind_that_is_tried():
    for page, actual in PRINTED.items():
        text = (ROOT / page).read_text(encoding="utf-8")
        assert len(re.findall("^```", text, re.MULTILINE)) == 2 * len(actual), page
    assert {block.kind for block in ALL} <= set(KINDS)
    assert [block for block in ALL if block.kind == "text"] == [output for _, output in OUTPUTS]
    assert [output.name for command, output in OUTPUTS if command not in RUN] == []


def test_what_is_not_run_exists():
    assert listed(*NOT_RUN) <= {first(block) for block in ALL if block.kind in ("", "pycon")}


def quoted_messages(page: str) -> list[str]:
    """Return the messages that begin the rows of tables below "What can go wrong"."""
    text = (ROOT / page).read_text(encoding="utf-8")
    _, _, below = text.partition("## What can go wrong\n")
    return re.findall(r"^\| `(.+?)` +\|", below, re.MULTILINE)


@pytest.fixture(scope="module")
def messages() -> str:
    """Return our code, with adjacent strings joined, Snakemake's, and bad input of tests."""
    ours = [ROOT / room for room in ("scripts", "workflow", "packages/latticode/latticode")]
    rooms = [*ours, Path(find_spec("snakemake").origin).parent]
    code = [path for room in rooms for end in ("py", "smk") for path in room.rglob(f"*.{end}")]
    code.append(ROOT / "tests/configuration/bad_input.yaml")
    text = "\n".join(path.read_text(encoding="utf-8") for path in code)
    return "\n".join([re.sub(r'"\s*\n\s*f?"', "", text), *SYSTEM])


SYSTEM = [
    # snakemake-executor-plugin-slurm, which is not installed where these tests run
    "No SLURM account given, trying to guess.",
    "has been submitted with SLURM jobid",
    "No matching distribution found for",  # pip
    "No such file or directory",
    "No module named venv",  # Python, where a system keeps this module apart
    "No module named 'pendula'",
    "invalid choice: 'slurm'",  # argparse: Snakemake without its plugin
]


@pytest.mark.parametrize("page", PAGES)
def test_a_message_that_a_page_explains_is_one_that_is_said(page, messages):
    pieces = [quote.strip() for output in quoted_messages(page) for quote in output.split("...")]
    assert [quote for quote in pieces if quote not in messages] == []
