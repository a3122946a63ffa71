# Speed against error, and how the cost grows. Not part of the full run: timing jobs run alone.


rule speed:
    "Speed against error of every solver and installed peer, and how cost grows (takes minutes)"
    input:
        "results/speed/table.md",
        "results/speed/growth.md",
        expand("results/figures/{name}.{kind}", name=SPEED_FIGURES, kind=["png", "pdf", "nc"]),


rule work_precision:
    input:
        code=code("speed/measure_work.py"),
        kernels=kernels(*ALL_SOLVERS),
        references=references(*PAPER_CASES),
    output:
        data="results/speed/work_precision.nc",
        table="results/speed/table.md",
    log:
        "results/logs/speed/work_precision.log",
    conda:
        "../envs/pinned.yaml"
    threads: workflow.cores
    params:
        problems={case: SETTINGS.problem(case) for case in PAPER_CASES},
    message:
        "Timing every solver and installed peer on the paper's cases"
    script:
        "../../scripts/speed/measure_work.py"


rule cost_growth:
    input:
        code=code("speed/measure_growth.py"),
        kernels=kernels("dop853", "taylor"),
    output:
        data="results/speed/growth.nc",
        table="results/speed/growth.md",
    log:
        "results/logs/speed/growth.log",
    conda:
        "../envs/pinned.yaml"
    threads: workflow.cores
    params:
        problem=SETTINGS.problem("fig3_small"),
    message:
        "Timing longer chains and longer runs"
    script:
        "../../scripts/speed/measure_growth.py"


rule speed_figures:
    input:
        code=code("figures/draw_speed.py"),
        work="results/speed/work_precision.nc",
        growth="results/speed/growth.nc",
    output:
        expand("results/figures/{name}.{kind}", name=SPEED_FIGURES, kind=["png", "pdf", "nc"]),
    log:
        "results/logs/figures/speed.log",
    conda:
        "../envs/pinned.yaml"
    params:
        regimes=list(REGIMES),
        stems=[f"results/figures/{name}" for name in SPEED_FIGURES],
    message:
        "Drawing speed against error, and how cost grows"
    script:
        "../../scripts/figures/draw_speed.py"


rule reproduction:
    "How long the whole reproduction takes, from nothing and with compiled kernels"
    input:
        program=f"{workflow.basedir}/tests/benchmarks/reproduction.py",
        code=code("trajectories/simulate_case.py"),
    output:
        table="results/speed/reproduction.md",
    log:
        "results/logs/speed/reproduction.log",
    conda:
        "../envs/pinned.yaml"
    threads: workflow.cores
    params:
        python=sys.executable,
    message:
        "Running the whole reproduction twice, in a copy of the project"
    shell:
        "{params.python:q} {input.program:q} > {output.table:q} 2> {log:q} && cat {output.table:q}"
