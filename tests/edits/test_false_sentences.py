"""The program that reads what a run says: it finds every false sentence that is planted."""

import json
import os
import shutil

import pytest
import xarray as xr
from false_sentences import false_sentences


def rewritten(path, text: str) -> None:
    path.unlink()  # else the shared run would change, to whose file this is a link
    path.write_text(text, encoding="utf-8")


def replaced(name: str, old: str, new: str):
    """Return what replaces words in a file of the results."""

    def plant(results) -> None:
        text = (results / name).read_text(encoding="utf-8")
        assert old in text, f"{name} has no {old}"
        rewritten(results / name, text.replace(old, new))

    return plant


def dataset(name: str, change):
    """Return what changes a dataset."""

    def plant(results) -> None:
        path = results / f"{name}.nc"
        changed = change(xr.load_dataset(path))
        path.unlink()
        changed.to_netcdf(path)

    return plant


def run_with(case: str, **keys):
    """Return what makes the run of a case one with other keys."""
    return dataset(f"trajectories/{case}", lambda run: run.assign_attrs(keys))


def row_of(claim: str, change):
    """Return what changes a row of the ledger."""

    def plant(results) -> None:
        claims = json.loads((path := results / "claims.json").read_text(encoding="utf-8"))
        for row in claims["rows"]:
            if claim == row["name"]:
                change(row)
        rewritten(path, json.dumps(claims))

    return plant


def failed(row):
    row["controls"][0]["passes"] = False


PLANTED = [
    ((run_with("fig2_small", boundary="periodic"),), "does not begin with fig2_small.boundary"),
    ((run_with("fig2_small", boundary="periodic"),), "of fig2 do not say that fig2_small.boundary"),
    ((run_with("fig3_small", gamma=0.5),), "of fig5 do not say that fig3_small.gamma"),
    (
        (replaced("report.html", "fig2_small.end_time (4 in", "fig2_small.end_time (5 in"),),
        "fig2_small.end_time (5 in place of 50), which was not run",
    ),
    ((replaced("report.html", "with other settings", "replicated"),), "The title".lower()),
    (
        (row_of("fig2_bounded", lambda row: row.update(verdict="confirmed")),),
        "the claim fig2_bounded is confirmed, and fig2_small is edited",
    ),
    ((row_of("theorem_3", failed),), "theorem_3 is confirmed, and its control"),
    ((replaced("figures/fig2.json", "Omega = 8", "Omega = 6"),), "fig2 has titles at Omega = [6.0"),
    ((replaced("figures/fig2.json", "Not the paper's", "As"),), "fig2 and its data do not both"),
    (
        (dataset("figures/fig2", lambda figure: figure.drop_attrs(deep=False)),),
        "of fig2 do not say that fig2_small.end_time",
    ),
]


def planted_in(full_run, folder, plants) -> list[str]:
    """Return what is false of a copy of a run with all these plants."""
    shutil.copytree(full_run / "results", folder / "results", copy_function=os.link)
    for plant in plants:
        plant(folder / "results")
    return false_sentences(folder)


@pytest.fixture(scope="module")
def said_of(full_run, tmp_path_factory):
    """Return what is false of the copies, each with every second planted falsehood."""
    folders = [tmp_path_factory.mktemp("planted") / "run" for _ in range(2)]
    return [
        planted_in(full_run, folder, [plant for plants, _ in PLANTED[first::2] for plant in plants])
        for first, folder in enumerate(folders)
    ]


def test_nothing_is_false_of_the_quick_run(full_run):
    assert false_sentences(full_run) == []


@pytest.mark.parametrize("number", range(len(PLANTED)), ids=[sentence for _, sentence in PLANTED])
def test_a_false_sentence_is_found(said_of, number):
    assert [sentence for sentence in said_of[number % 2] if PLANTED[number][1] in sentence] != []
