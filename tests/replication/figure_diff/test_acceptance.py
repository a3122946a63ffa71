"""Accepting: what is refused, what is taken, by name or all; and the baseline guards itself."""

import netCDF4
import numpy as np
import pytest
from latticode.datasets.json_files import load_json, write_json
from latticode.datasets.netcdf import read
from made_up_results import (
    CHAOTIC,
    CONFIGURATION,
    LEDGER,
    LIVE,
    NAMES,
    PICTURE,
    REGULAR,
    REPORT,
    TABLE,
)
from replication.figure_diff import Status, acceptance, baseline, hashes
from replication.figure_diff.acceptance import AcceptanceError, check, choose

SHORT = {"cases": {"fig2_small": {"end_time": 4, "omega": 8}}}


def larger(data):
    """Return a dataset with its norms multiplied."""
    return data.assign(l2=data["l2"] * 1.5)


def contents(folder) -> dict[str, bytes]:
    """Return all files below a folder."""
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def test_another_configuration_is_refused_by_what_is_other():
    with pytest.raises(AcceptanceError) as refused:
        check(SHORT, CONFIGURATION, "the configuration of config/*.yaml", acceptance.WAY_OUT)
    text = str(refused.value)
    assert text.startswith("nothing is accepted: this run does not match the configuration of ")
    assert "cases.fig2_small.end_time is 4 in place of 50" in text and "--config baseline=" in text


@pytest.mark.parametrize(
    ("word", "files"),
    [
        ("fig2", [f"figures/fig2.{kind}" for kind in ("json", "nc", "pdf", "png")]),
        ("trajectories/fig4_small", [CHAOTIC]),
        (LEDGER, [LEDGER]),
        ("figures/*.nc", ["figures/fig2.nc", "figures/fig4.nc"]),
    ],
)
def test_names_are_those_of_files_and_figures(word, files):
    assert choose([word, word], NAMES) == files


def test_a_name_of_nothing_is_refused_with_the_nearest():
    with pytest.raises(AcceptanceError, match=r"fig22 names no file .* did you mean fig2\?"):
        choose(["fig4", "fig22"], NAMES)


def test_accepting_takes_what_changed_and_the_same_run_again_changes_no_byte(run):
    run.change(REGULAR, larger)
    before = contents(run.accepted)
    report = run.accept()
    assert report.startswith(f"{len(NAMES)} files accepted, 1 of them new or changed, 0 removed")
    after = contents(run.accepted)
    assert {name for name in after if after[name] != before[name]} == {REGULAR, baseline.RECORD}
    assert not run.judge().faults
    assert "0 of them new or changed" in run.accept() and contents(run.accepted) == after


def test_only_what_is_named_is_taken_and_what_is_no_longer_made_is_removed(run):
    for name in (REGULAR, CHAOTIC):
        run.change(name, larger)
    assert "1 of them new or changed" in run.accept(words=["trajectories/fig2_small"])
    assert [result.name for result in run.judge().findings if result.status.is_fault] == [CHAOTIC]
    assert "1 removed" in run.accept([name for name in NAMES if name != PICTURE])
    assert not (run.accepted / PICTURE).exists()
    assert run.findings()[PICTURE].status == Status.EXTRA


@pytest.mark.parametrize("name", [REGULAR, PICTURE, LEDGER, TABLE, "figures/fig2.pdf"])
def test_an_empty_file_is_refused_and_nothing_changed(run, name):
    run.change(CHAOTIC, larger)
    (run.made / name).write_bytes(b"")
    before = contents(run.accepted)
    with pytest.raises(AcceptanceError, match=r"nothing is accepted: .*run snakemake to make it"):
        run.accept()
    assert contents(run.accepted) == before


def test_files_of_two_environments_or_configurations_do_not_mix(run):
    with pytest.raises(AcceptanceError, match=r"end_time is 4 in place of 50.*accept all files"):
        acceptance.accept(NAMES, *run, SHORT, [REGULAR])
    run.pretend("drawing", "matplotlib")
    with pytest.raises(AcceptanceError, match=r"matplotlib is .* in place of 0.0.*accept all"):
        run.accept(words=["fig2"])
    run.accept()
    assert baseline.recorded(run.accepted)["environment"] == baseline.environment()


def test_what_is_kept_is_every_sample_in_single_precision_unless_more_digits_are_declared(run):
    def declared(data):
        exact = data["l2"].assign_attrs(significant_digits=7)
        return data.assign(exact=exact, l2=exact.assign_attrs(significant_digits=6))

    run.change(REGULAR, declared)
    run.accept()
    accepted, computed = (read(folder / REGULAR) for folder in (run.accepted, run.made))
    assert accepted["exact"].identical(computed["exact"]) and accepted.attrs == computed.attrs
    assert accepted["l2"].dtype == np.float32
    assert np.array_equal(accepted["l2"], computed["l2"].astype("float32"))
    with netCDF4.Dataset(run.accepted / REGULAR) as data:
        assert data["l2"].filters()["zlib"] and data["l2"].filters()["complevel"] == 9
    absent = {name for name in NAMES if not (run.accepted / name).exists()}
    assert absent == {REPORT, LIVE, "figures/fig2.pdf", "figures/fig4.pdf"}


@pytest.mark.parametrize("name", [REGULAR, PICTURE, LEDGER])
@pytest.mark.parametrize("how", ["edited", "missing"])
def test_a_copy_in_the_baseline_that_is_not_as_accepted_is_a_fault(run, name, how):
    """Else a fault that is planted into both copies would pass where the bits are others."""
    path = run.accepted / name
    path.unlink() if how == "missing" else path.write_bytes(path.read_bytes() + b"\n")
    for any_bits in (False, True):
        result = run.findings(any_bits=any_bits)[name]
        assert result.status == Status.DAMAGED
        assert how in result.reason and "restore" in result.reason


@pytest.mark.parametrize("name", ["../thesis.md", "/thesis.md", "thesis.docx", "up/thesis.md"])
def test_a_baseline_that_names_what_no_run_makes_is_refused_and_nothing_removed(run, name):
    """`up` is a link that leads out of the baseline."""
    (run.accepted / "up").symlink_to(run.made.parent)
    thesis = run.accepted / name if name != "/thesis.md" else run.made.parent / "thesis.md"
    thesis.write_text("mine")
    record = load_json(run.accepted / baseline.RECORD)
    named = str(thesis) if name == "/thesis.md" else name
    record["files"][named] = hashes.of_bytes(b"mine")
    write_json(run.accepted / baseline.RECORD, record)
    with pytest.raises(AcceptanceError, match=r"thesis.* which no run makes"):
        run.accept()
    assert thesis.read_text() == "mine" and run.findings()[baseline.RECORD].status.is_fault


def test_a_file_that_is_no_longer_made_is_not_removed_once_it_was_edited(run):
    (run.accepted / TABLE).write_text("notes of mine")
    with pytest.raises(AcceptanceError, match=r"claims.md, which no run makes, was edited"):
        run.accept([name for name in NAMES if name != TABLE])
    assert (run.accepted / TABLE).read_text() == "notes of mine"


def test_edited_hashes_are_a_fault(run):
    path = run.accepted / baseline.RECORD
    path.write_text(path.read_text().replace("float64", "float32", 1))
    (result,) = run.judge().findings
    assert result.status == Status.DAMAGED and result.name == baseline.RECORD
    with pytest.raises(AcceptanceError, match=f"{baseline.RECORD} is damaged"):
        run.accept()
