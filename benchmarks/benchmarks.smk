# Speed against error, and the cost of a run. Not part of the full run: timing jobs run alone.


rule speed:
    "Speed against error of every solver and installed peer, and what runs cost (takes minutes)"
    input:
        "results/speed/work_precision.md",
        "results/speed/cost.md",
        "results/speed/pendula.md",
        expand("results/figures/{name}.{kind}", name=SPEED_FIGURES, kind=FIGURE_KINDS.values()),
    message:
        "The measurements of speed are there"


rule work_precision:
    "Part of speed: every solver and installed peer on the cases of the paper, timed"
    input:
        code=code("benchmarks/jobs/measure_work_precision.py"),
        kernels=kernels(*ALL_SOLVERS),
        references=references(*PAPER_CASES),
    output:
        data="results/speed/work_precision.nc",
    log:
        "results/logs/speed/work_precision.log",
    conda:
        "../workflow/envs/pinned.yaml"
    threads: workflow.cores
    params:
        problems={case: SETTINGS.problem(case) for case in PAPER_CASES},
    message:
        "Timing every solver and installed peer on the paper's cases"
    script:
        "jobs/measure_work_precision.py"


rule speed_pendula:
    "Part of speed: every solver and installed peer on Newton's equations, timed"
    input:
        code=code("benchmarks/jobs/measure_pendula.py"),
    output:
        data="results/speed/pendula.nc",
        table="results/speed/pendula.md",
    log:
        "results/logs/speed/pendula.log",
    conda:
        "../workflow/envs/pinned.yaml"
    threads: workflow.cores
    params:
        problems={case: SETTINGS.problem(case) for case in REGIMES["regular"].cases},
    message:
        "Timing every solver and installed peer on Newton's equations"
    script:
        "jobs/measure_pendula.py"


rule cost:
    "Part of speed: longer chains, longer runs and more active sites, timed"
    input:
        code=code("benchmarks/jobs/measure_cost.py"),
        kernels=kernels("dop853", "taylor"),
    output:
        data="results/speed/cost.nc",
    log:
        "results/logs/speed/cost.log",
    conda:
        "../workflow/envs/pinned.yaml"
    threads: workflow.cores
    params:
        problem=SETTINGS.problem("fig3_small"),
    message:
        "Timing longer chains, longer runs and more active sites"
    script:
        "jobs/measure_cost.py"


rule speed_tables:
    "Part of speed: what was timed, as tables to read"
    input:
        code=code("benchmarks/jobs/tabulate_speed.py"),
        work_precision="results/speed/work_precision.nc",
        cost="results/speed/cost.nc",
    output:
        work_precision_table="results/speed/work_precision.md",
        cost_table="results/speed/cost.md",
    log:
        "results/logs/speed/tables.log",
    conda:
        "../workflow/envs/pinned.yaml"
    message:
        "Tabling the measurements of speed"
    script:
        "jobs/tabulate_speed.py"


rule speed_figures:
    "Part of speed: what was timed, as figures"
    input:
        code=code("benchmarks/jobs/draw_speed.py"),
        work_precision="results/speed/work_precision.nc",
        cost="results/speed/cost.nc",
    output:
        expand("results/figures/{name}.{kind}", name=SPEED_FIGURES, kind=FIGURE_KINDS.values()),
    log:
        "results/logs/figures/speed.log",
    conda:
        "../workflow/envs/pinned.yaml"
    params:
        regimes=list(REGIMES),
        stems=[f"results/figures/{name}" for name in SPEED_FIGURES],
    message:
        "Drawing speed against error, and what runs cost"
    script:
        "jobs/draw_speed.py"


rule reproduction:
    "Where the time of the whole reproduction goes, from nothing and with compiled kernels"
    input:
        program=code("benchmarks/reproduction.py"),
        code=code("trajectories/simulate_case.py"),
    output:
        data="results/speed/reproduction.json",
        table="results/speed/reproduction.md",
    log:
        "results/logs/speed/reproduction.log",
    conda:
        "../workflow/envs/pinned.yaml"
    threads: workflow.cores
    params:
        python=sys.executable,
    message:
        "Running the whole reproduction twice, in a copy of the project"
    shell:
        "{params.python:q} -m benchmarks.reproduction {output.data:q} > {output.table:q} 2> {log:q} &&"
        " cat {output.table:q}"
