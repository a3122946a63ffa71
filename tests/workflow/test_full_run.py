"""One full run of the quick configuration, by the real snakemake: figures, checks, ledger."""

import xarray as xr
from latticode.datasets.checks import broken
from latticode.datasets.digest import fingerprint
from latticode.datasets.json_files import load_json
from pendula.jobs.decide import all_claims
from pendula.studies.theory.checks import CHECKS
from replication.ledger.criterion import Verdict
from replication.ledger.decide import decide_claims, tabulate_claims
from replication.ledger.verdicts import needed


def test_every_picture_shows_what_is_described_beside_it(full_run):
    described = sorted((full_run / "results/figures").glob("*.json"))
    assert len(described) >= 15
    for path in described:
        mark = fingerprint(path.read_text(encoding="utf-8")).encode()
        png, pdf = (path.with_suffix(kind).read_bytes() for kind in (".png", ".pdf"))
        assert png.startswith(b"\x89PNG") and pdf.startswith(b"%PDF")
        assert mark in png and mark in pdf, path.name
    assert not (full_run / "results/reference").exists()  # which takes half an hour


def ledger_of(folder):
    return load_json(folder / "results/claims.json")["rows"]


def test_every_check_is_written_and_holds(full_run):
    for name in ("identities", "cases", *CHECKS):
        with xr.open_dataset(full_run / f"results/checks/{name}.nc") as check:
            assert broken(check.to_dict()) == {}, name


def test_the_ledger_has_every_row_with_every_field(full_run):
    rows = ledger_of(full_run)
    assert sorted(row["name"] for row in rows) == sorted(claim.name for claim in all_claims())
    for row in rows:
        assert all((full_run / f"results/{name}.nc").exists() for name in row["decided_by"])
        if row["verdict"] in (Verdict.UNDECIDED, Verdict.NOT_APPLICABLE):
            assert row["because"]
        else:
            assert row["measured"] and row["criterion"]


def test_other_cases_than_the_papers_decide_theorems_and_no_figure(full_run):
    rows = {row["name"]: row for row in ledger_of(full_run)}
    verdicts = {name: row["verdict"] for name, row in rows.items()}
    assert verdicts["fig6_constant"] == verdicts["fig2_bounded"] == Verdict.NOT_APPLICABLE
    assert "fig6_left.half_widths ([4, 6, 8] in place" in rows["fig6_constant"]["because"]
    page = (full_run / "results/report.html").read_text(encoding="utf-8")
    assert "This run does not use the paper's cases." in page
    assert "fig2_small.end_time (4 in place of 50)" in page
    assert verdicts["theorem_1"] == Verdict.CONFIRMED
    assert verdicts["theorem_3_proof"] == Verdict.NOT_REPRODUCED


def test_a_violated_check_turns_its_claim_and_no_other(full_run, tmp_path):
    part_of_ledger = load_json(full_run / "results/claims/theory.json")
    names = needed(all_claims("theory/claims"))
    paths = {name: str(full_run / f"results/{name}.nc") for name in names}
    check = xr.load_dataset(paths["checks/identities"])
    check["terms"].loc["(7)", "free"] = 1
    check.to_netcdf(wrong := str(tmp_path / "identities.nc"))
    paths["checks/identities"] = wrong
    results, table = str(tmp_path / "theory.json"), tmp_path / "theory.md"
    decide_claims(all_claims("theory/claims"), list(paths.values()), list(paths), results)
    tabulate_claims([results], str(table))
    verdicts = (
        {row["name"]: row["verdict"] for row in entry["rows"]}
        for entry in (part_of_ledger, load_json(results))
    )
    before, after = verdicts
    applicable = [name for name in before if before[name] != Verdict.NOT_APPLICABLE]
    turned = {name: after[name] for name in applicable if after[name] != before[name]}
    assert turned == {"hamiltonian": Verdict.NOT_REPRODUCED}
    assert "| not reproduced |" in table.read_text()
