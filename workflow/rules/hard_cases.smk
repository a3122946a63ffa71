# What the solvers do where they are most likely to fail.


rule hard_cases:
    "Hard cases: digits with their error, or a refusal in words, of every solver"
    input:
        code=code("hard_cases/run_hard_cases.py"),
        kernels=kernels(*ALL_SOLVERS, "taylor"),
    output:
        data="results/checks/hard_cases.nc",
    log:
        "results/logs/checks/hard_cases.log",
    conda:
        "../envs/pinned.yaml"
    params:
        cases=SETTINGS.hard_cases.plain(),
    message:
        "Running the solvers on hard cases"
    script:
        "../../scripts/hard_cases/run_hard_cases.py"


rule hard_cases_table:
    "The hard cases as a table to read: results/tables/hard_cases.md"
    input:
        code=code("hard_cases/tabulate_hard_cases.py"),
        data="results/checks/hard_cases.nc",
    output:
        table="results/tables/hard_cases.md",
    log:
        "results/logs/tables/hard_cases.log",
    conda:
        "../envs/pinned.yaml"
    message:
        "Tabling the hard cases"
    script:
        "../../scripts/hard_cases/tabulate_hard_cases.py"
