"""What the benchmark of a whole run reads from Snakemake's records, and how it starts a run."""

import json
import subprocess

from benchmarks import reproduction


def record(folder, output, rule, start, end):
    """Write the record of an output as Snakemake does: the file is named after the output."""
    data = {"rule": rule, "starttime": start, "endtime": end}
    (folder / output.replace("/", "@")).write_text(json.dumps(data))


def test_a_job_with_several_outputs_counts_once(tmp_path):
    folder = tmp_path / ".snakemake/metadata"
    folder.mkdir(parents=True)
    record(folder, "results/figures/fig5.png", "fig5", 10.0, 12.0)
    record(folder, "results/figures/fig5.pdf", "fig5", 10.0, 12.0)
    record(folder, "results/sweeps/a.nc", "sweep", 1.0, 4.0)
    record(folder, "results/sweeps/b.nc", "sweep", 2.0, 7.0)
    record(folder, "results/raw.txt", None, 0.0, 0.0)
    times = reproduction.rule_times(tmp_path)
    assert {rule: sorted(seconds) for rule, seconds in times.items()} == {
        "fig5": [2.0],
        "sweep": [3.0, 5.0],
    }


def test_a_run_finds_no_kernels_but_its_own(tmp_path, monkeypatch):
    started = {}
    monkeypatch.setenv("PENDULA_CACHE", "/elsewhere")
    monkeypatch.setattr(subprocess, "run", lambda command, **options: started.update(options))
    assert 0.0 <= reproduction.run(tmp_path) < 1.0
    assert started["cwd"] == tmp_path and started["check"]
    assert "PENDULA_CACHE" not in started["env"]


def test_three_runs_and_the_jobs_of_the_last_are_told(monkeypatch, capsys):
    def run(project):
        folder = project / ".snakemake/metadata"
        folder.mkdir(parents=True, exist_ok=True)
        (project / "results").mkdir(exist_ok=True)
        record(folder, "results/fig5.png", "fig5", 10.0, 12.0)
        return 7.0

    monkeypatch.setattr(reproduction.shutil, "copytree", lambda *_, **__: None)
    monkeypatch.setattr(reproduction, "run", run)
    reproduction.main()
    said = capsys.readouterr().out
    assert said.count("| 7.0 |") == 3 and "| fig5 | 1 | 2.0 |" in said
