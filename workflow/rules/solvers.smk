# The paper's two solvers side by side, against one of high order.


rule solver_figures:
    "How well each solver conserves the energy, and until when they draw the same curves"
    input:
        code=code("figures/draw_solvers.py"),
        trajectories=expand(
            "results/trajectories/{case}.{solver}.nc", case=PAPER_CASES, solver=COMPARED
        ),
    output:
        **figure("energy_drift", "energy_"),
        **figure("solver_agreement"),
    log:
        "results/logs/figures/solvers.log",
    conda:
        "../envs/pinned.yaml"
    params:
        cases=PAPER_CASES,
        solvers=COMPARED,
    message:
        "Drawing how the solvers conserve the energy, and until when they agree"
    script:
        "../../scripts/figures/draw_solvers.py"


rule solver_table:
    "The same in numbers, with the sweeps: results/tables/solvers.md"
    input:
        code=code("tables/compare_solvers.py"),
        energy="results/figures/energy_drift.nc",
        agreement="results/figures/solver_agreement.nc",
        first=expand("results/sweeps/{sweep}.nc", sweep=PAPER_SWEEPS),
        second=expand("results/sweeps/{sweep}.crank_nicolson.nc", sweep=PAPER_SWEEPS),
    output:
        table="results/tables/solvers.md",
    log:
        "results/logs/tables/solvers.log",
    conda:
        "../envs/pinned.yaml"
    params:
        sweeps=PAPER_SWEEPS,
    message:
        "Tabling energy drift and agreement of the solvers"
    script:
        "../../scripts/tables/compare_solvers.py"
