"""Functions that rules share: names of files, chunks, values, hashes, resources, refusals."""

import os
from types import SimpleNamespace

import pytest
from helpers import ROOT, chosen
from latticode.configuration.cost import RunCost
from latticode.configuration.files import ConfigurationError, gather
from pendula.configuration.messages import load
from pendula.configuration.schema import PAPER_CASES
from pendula.jobs.decide import all_claims
from pendula.studies import STUDIES, files_with_prefix
from pendula.workflow import ledger, options
from pendula.workflow.code import committed, function
from pendula.workflow.files import (
    any_of,
    chunks_in,
    chunks_of,
    chunks_of_surveys,
    figure_files,
    kernels,
    kernels_for,
    own_files,
    runs_by,
)
from pendula.workflow.refusals import read_only_folders
from pendula.workflow.resources import resources_for
from pendula.workflow.values import by_size, values_of
from replication.ledger.verdicts import needed


@pytest.fixture(scope="module")
def settings():
    return load(gather(options.project_files(ROOT), {}))


def test_a_pattern_of_no_names_matches_nothing():
    assert any_of(["a", "b"]) == "a|b" and any_of([]) == "(?!)"


def test_a_figure_is_four_files_and_auto_waits_for_two_kernels():
    assert figure_files("x") == ["x.png", "x.pdf", "x.nc", "x.json"]
    both = ["<results>/kernels/taylor.txt", "<results>/kernels/dop853.txt"]
    assert kernels("auto") == both
    assert kernels_for({"solver": {"name": "auto"}}) == both
    assert kernels_for({"model": "pendula", "solver": {"name": "taylor"}}) == []


class Places(dict):
    """Wildcards as Snakemake hands them to input functions."""


def gather_of(count: int) -> SimpleNamespace:
    """Return Snakemake's object `gather` of a workflow whose process `runs` has so many items."""

    def runs(pattern: str) -> list[str]:
        return [pattern.format(scatteritem=f"{n}-of-{count}") for n in range(1, count + 1)]

    return SimpleNamespace(runs=runs)


def test_a_study_has_chunks_if_there_are_more_than_one_and_a_chunk_has_none():
    files = chunks_of(gather_of(3), "{size}breathers/fates")
    assert files(Places(size="long/", chunk=""))[1] == (
        "<results>/long/breathers/fates.parts/2-of-3.nc"
    )
    assert files(Places(size="", chunk=".parts/2-of-3")) == []
    assert chunks_of(gather_of(1), "checks/members")(Places(chunk="")) == []
    assert (chunks_in(".parts/2-of-3"), chunks_in("")) == (3, 1)


def survey(runs: int, chunks: int | None = None) -> SimpleNamespace:
    return SimpleNamespace(plan=SimpleNamespace(shape=(runs,)), chunks=chunks)


def test_a_survey_has_its_own_chunks_those_of_the_call_or_eight_and_no_more_than_runs():
    surveys = {"own": survey(100, 4), "other": survey(100), "small": survey(2)}
    assert chunks_of_surveys(surveys, {}) == {
        "survey_own": 4,
        "survey_other": 8,
        "survey_small": 2,
    }
    assert chunks_of_surveys(surveys, {"runs": 50})["survey_other"] == 50


def test_the_number_of_chunks_is_no_key_of_config_any_more():
    with pytest.raises(ConfigurationError, match="--set-scatter runs=8"):
        options.take_options({"chunks": 8}, {"chunks": 8})


@pytest.mark.parametrize("settings", [{"bits": "some"}, {"baseline": 7}])
def test_an_option_of_a_call_with_a_wrong_value_is_refused(settings):
    with pytest.raises(ConfigurationError, match=f"--config {next(iter(settings))}="):
        options.take_options({}, settings)


def test_options_of_a_call_are_no_keys_of_the_configuration():
    config = {"bits": "any", "accept": "fig3", "cases": {}}
    assert options.take_options(config, dict(config)) == (None, True, ["fig3"])
    assert config == {"cases": {}}


def test_settings_are_plain_values_and_those_of_a_longer_study_follow_its_wildcard(settings):
    section = settings.newton.over_the_top
    assert values_of(section, "seed") == {"seed": section.seed} and "long" not in values_of(section)
    of_size = by_size(section, "members")["members"]
    sizes = [of_size(SimpleNamespace(size=size)) for size in ("", "long/")]
    assert sizes == [section.members, section.long.members]


def test_a_committed_file_is_a_path_in_the_project_with_a_digest():
    entry = committed("tests/baseline/quoted/chaos.nc")
    assert entry["committed"] == "tests/baseline/quoted/chaos.nc" and len(entry["sha256"]) == 64


def test_a_function_has_a_hash_of_its_code_and_what_else_reruns_it():
    name = "pendula.studies.theory.bounds.check_observed"
    first, digest = function(name)
    assert first == name and len(digest) == 64
    assert function(name, also=["1.0"]) == [name, digest, "1.0"]
    assert function(name, modules=["pendula.studies.theory.claims_model"])[1] != digest


def test_each_module_of_claims_is_in_one_part_of_the_ledger():
    modules_by_part = ledger.parts_of_ledger()
    listed = [
        module for modules in modules_by_part.values() for module in ledger.modules_of(modules)
    ]
    paths = [path for study in STUDIES for path in files_with_prefix(f"{study}/claims")]
    assert sorted(listed) == sorted(f"pendula.studies.{p.parent.name}.{p.stem}" for p in paths)
    claims = [claim.name for modules in modules_by_part.values() for claim in all_claims(*modules)]
    assert sorted(claims) == sorted(claim.name for claim in all_claims())


def test_the_datasets_of_a_part_are_those_that_its_claims_need_also_from_the_cache(
    tmp_path, monkeypatch
):
    monkeypatch.setenv("LATTICODE_CACHE", str(tmp_path / "cache"))
    modules = ledger.parts_of_ledger()["chaos"]
    names = ledger.datasets_of_claims(modules, "0" * 64)
    assert names == needed(all_claims(*modules)) and "checks/ensembles" in names
    assert len(list((tmp_path / "cache/claims").glob("*.json"))) == 1
    assert ledger.datasets_of_claims([], "0" * 64) == names
    monkeypatch.setenv("LATTICODE_CACHE", "off")
    certified = needed(all_claims("certified/claims"))
    assert ledger.datasets_of_claims(["certified/claims"], "0" * 64) == certified


def test_trajectories_by_most_cases_own_solver_have_no_solver_in_their_name(settings):
    assert runs_by(settings, "taylor")[0].endswith("/fig2_small.taylor.nc")
    assert len(runs_by(settings, "ode45")) == len(PAPER_CASES)


def test_a_configuration_without_own_cases_is_refused_their_report(settings):
    with pytest.raises(ConfigurationError, match=r"docs/own_cases\.md"):
        own_files(settings)


def test_a_second_attempt_requests_twice_the_memory_and_the_time():
    requests = resources_for(lambda _: RunCost(seconds=600.0, memory=5e8))
    assert [requests["runtime"](None, attempt) for attempt in (1, 2)] == [65, 130]
    assert [requests["mem_mb"](None, attempt) for attempt in (1, 2)] == [2000, 4000]


def test_a_read_only_folder_above_a_file_is_found(tmp_path, monkeypatch):
    (tmp_path / "open").mkdir()
    (tmp_path / "shut").mkdir()
    monkeypatch.setattr(os, "access", lambda path, _: "shut" not in str(path))
    files = [tmp_path / "open/a/b.nc", tmp_path / "shut/c/d.nc"]
    assert read_only_folders(map(str, files)) == [tmp_path / "shut"]


def test_the_problem_of_a_sweeps_member_ends_with_the_drawn_windows(settings):
    member = settings.chaos.member_of(settings, "fig6_right")
    assert member["problem"]["end_time"] == max(end for _, end in member["windows"])
    steps = [p["solver"]["step"] for p in settings.chaos.by_second_solver(settings, "fig6_left")]
    assert steps == sorted(set(steps)) and len(steps) == 2
    assert chosen("reference").problem(settings, "fig4_small")["end_time"] >= 50.0
