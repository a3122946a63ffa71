# Until when each solver's trajectories are the true ones.


rule trust_horizons:
    "When each solver's norms leave the multiprecision reference"
    input:
        code=code("trust/judge_trajectories.py"),
        trajectories=expand(
            "results/trajectories/{case}.{solver}.nc", case=PAPER_CASES, solver=ALL_SOLVERS
        ),
        references=references(*PAPER_CASES),
    output:
        **figure("trust_horizons"),
        table="results/tables/trust.md",
    log:
        "results/logs/trust/horizons.log",
    conda:
        "../envs/pinned.yaml"
    params:
        cases=PAPER_CASES,
        solvers=ALL_SOLVERS,
    message:
        "Judging until when each solver's trajectories can be trusted"
    script:
        "../../scripts/trust/judge_trajectories.py"
