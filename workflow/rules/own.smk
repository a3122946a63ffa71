# Cases and sweeps of one's own: figures, checks, and a report, as for those of the paper.


rule own:
    "A report of the cases and sweeps in your --configfile: results/own_report.html"
    input:
        "results/own_report.html",
    message:
        "The report of your own cases and sweeps is there"


rule own_checks:
    "The checks of a case of your own: results/own/cases/{case}.checks.nc"
    input:
        code=code("own/check_case.py"),
        kernels=kernels("taylor", "dop853"),
        run="results/trajectories/{case}.nc",
    output:
        checks="results/own/cases/{case}.checks.nc",
    log:
        "results/logs/own/cases/{case}.checks.log",
    wildcard_constraints:
        case=one_of(OWN_CASES),
    conda:
        "../envs/pinned.yaml"
    params:
        problem=lambda wildcards: SETTINGS.shown_problem(wildcards.case),
    message:
        "Checking {wildcards.case}, and running it by another method"
    script:
        "../../scripts/own/check_case.py"


rule own_figures:
    "The figures of a case of your own: results/own/cases/{case}.png"
    input:
        code=code("own/draw_case.py"),
        run="results/trajectories/{case}.nc",
        checks="results/own/cases/{case}.checks.nc",
    output:
        norms=files_of("results/own/cases/{case}"),
        spacetime=files_of("results/own/cases/{case}.spacetime"),
    log:
        "results/logs/own/cases/{case}.log",
    wildcard_constraints:
        case=one_of(OWN_CASES),
    conda:
        "../envs/pinned.yaml"
    message:
        "Drawing {wildcards.case}"
    script:
        "../../scripts/own/draw_case.py"


rule own_sweep_figure:
    "The figure and checks of a sweep of your own: results/own/sweeps/{sweep}.png"
    input:
        code=code("own/draw_sweep.py"),
        sweep="results/sweeps/{sweep}.nc",
    output:
        figure=files_of("results/own/sweeps/{sweep}"),
        checks="results/own/sweeps/{sweep}.checks.nc",
    log:
        "results/logs/own/sweeps/{sweep}.log",
    wildcard_constraints:
        sweep=one_of(OWN_SWEEPS),
    conda:
        "../envs/pinned.yaml"
    params:
        name="{sweep}",
        text_window=lambda wildcards: drawn_windows(wildcards.sweep)["text_window"],
        caption_window=lambda wildcards: drawn_windows(wildcards.sweep)["caption_window"],
    message:
        "Drawing {wildcards.sweep}"
    script:
        "../../scripts/own/draw_sweep.py"


rule own_report:
    "The job behind own"
    input:
        code=code("own/write_report.py"),
        files=some_own_files,
    output:
        html="results/own_report.html",
    log:
        "results/logs/own/report.log",
    conda:
        "../envs/pinned.yaml"
    params:
        cases=OWN_CASES,
        sweeps={sweep: SETTINGS.sweeps[sweep].case for sweep in OWN_SWEEPS},
    message:
        "Writing the report of your own cases and sweeps"
    script:
        "../../scripts/own/write_report.py"
