# The paper's Figs 1 to 6, the chain in motion beside them, and its solvers side by side.
# Every figure is written as PNG and PDF, with the data that it shows as netCDF.


rule fig1:
    "Fig 1: the chain of coupled pendula pairs"
    input:
        code=code("paper/draw_chain.py"),
    output:
        **figure("fig1"),
    log:
        "results/logs/figures/fig1.log",
    conda:
        "../envs/pinned.yaml"
    message:
        "Drawing Fig 1, the chain of pendula pairs"
    script:
        "../../scripts/paper/draw_chain.py"


rule fig2:
    "Fig 2: norms against time, for small and for large data"
    input:
        code=code("paper/draw_norms.py"),
        small="results/trajectories/fig2_small.nc",
        large="results/trajectories/fig2_large.nc",
        references=references("fig2_small", "fig2_large"),
        ensembles=ensembles_of("fig2_small", "fig2_large"),
    output:
        norms=files_of("results/figures/fig2"),
        spacetime=files_of("results/figures/fig2_spacetime"),
    log:
        "results/logs/figures/fig2.log",
    conda:
        "../envs/pinned.yaml"
    params:
        differs=differs_of,
    message:
        "Drawing Fig 2, norms against time"
    script:
        "../../scripts/paper/draw_norms.py"


use rule fig2 as fig3 with:
    "Fig 3: norms against time, for small and for large data"
    input:
        code=code("paper/draw_norms.py"),
        small="results/trajectories/fig3_small.nc",
        large="results/trajectories/fig3_large.nc",
        references=references("fig3_small", "fig3_large"),
        ensembles=ensembles_of("fig3_small", "fig3_large"),
    output:
        norms=files_of("results/figures/fig3"),
        spacetime=files_of("results/figures/fig3_spacetime"),
    log:
        "results/logs/figures/fig3.log",
    message:
        "Drawing Fig 3, norms against time"


use rule fig2 as fig4 with:
    "Fig 4: norms against time, for small and for large data"
    input:
        code=code("paper/draw_norms.py"),
        small="results/trajectories/fig4_small.nc",
        large="results/trajectories/fig4_large.nc",
        references=references("fig4_small", "fig4_large"),
        ensembles=ensembles_of("fig4_small", "fig4_large"),
    output:
        norms=files_of("results/figures/fig4"),
        spacetime=files_of("results/figures/fig4_spacetime"),
    log:
        "results/logs/figures/fig4.log",
    message:
        "Drawing Fig 4, norms against time"


rule fig5:
    "Fig 5: norms against half-width for small data"
    input:
        code=code("paper/draw_sweeps.py"),
        left="results/sweeps/fig5_left.nc",
        right="results/sweeps/fig5_right.nc",
        ensembles=ensembles_of("fig5_left", "fig5_right"),
    output:
        **figure("fig5"),
    log:
        "results/logs/figures/fig5.log",
    conda:
        "../envs/pinned.yaml"
    params:
        **drawn_windows("fig5_left"),
        differs=differs_of,
        norms=["l2", "linf"],
    message:
        "Drawing Fig 5, norms against half-width for small data"
    script:
        "../../scripts/paper/draw_sweeps.py"


use rule fig5 as fig6 with:
    "Fig 6: norms against half-width for large data"
    input:
        code=code("paper/draw_sweeps.py"),
        left="results/sweeps/fig6_left.nc",
        right="results/sweeps/fig6_right.nc",
        ensembles=ensembles_of("fig6_left", "fig6_right"),
    output:
        **figure("fig6"),
    log:
        "results/logs/figures/fig6.log",
    params:
        **drawn_windows("fig6_left"),
        differs=differs_of,
        norms=["l2"],
    message:
        "Drawing Fig 6, norms against half-width for large data"


rule measure_solvers:
    "How well each solver conserves the energy, and until when pairs of them agree"
    input:
        code=code("paper/measure_solvers.py"),
        trajectories=expand(
            "results/trajectories/{case}.{solver}.nc", case=PAPER_CASES, solver=COMPARED
        ),
        first=expand("results/sweeps/{sweep}.nc", sweep=PAPER_SWEEPS),
        second=expand("results/sweeps/{sweep}.crank_nicolson.nc", sweep=PAPER_SWEEPS),
    output:
        data="results/checks/solvers.nc",
    log:
        "results/logs/checks/solvers.log",
    conda:
        "../envs/pinned.yaml"
    params:
        cases=PAPER_CASES,
        solvers=COMPARED,
        sweeps=PAPER_SWEEPS,
        others=other_cases("ode45"),
    message:
        "Measuring how the solvers conserve the energy, and until when they agree"
    script:
        "../../scripts/paper/measure_solvers.py"


rule measure_second_solver:
    "What depends on the scheme and the step of the second solver, which the paper hardly describes"
    input:
        code=code("paper/measure_second_solver.py"),
        kernels=kernels("crank_nicolson", "delfour_fortin_payre"),
        firsts=trajectories(".ode45"),
    output:
        data="results/checks/second_solver.nc",
    log:
        "results/logs/checks/second_solver.log",
    conda:
        "../envs/pinned.yaml"
    params:
        problems={case: SETTINGS.problem(case, "crank_nicolson") for case in PAPER_CASES},
        swept=SETTINGS.swept_problem("fig6_right", "crank_nicolson"),
        half_widths=SETTINGS.chaos.ensembles.sweeps["fig6_right"].half_widths,
        windows=SETTINGS.sweeps["fig6_right"].windows,
        ensemble={key: getattr(SETTINGS.chaos.ensembles, key) for key in ("size", "seed")},
    message:
        "Measuring what the scheme and the step of the second solver decide"
    script:
        "../../scripts/paper/measure_second_solver.py"


rule solver_figures:
    "The two figures energy_drift and solver_agreement: the solvers compared"
    input:
        code=code("paper/draw_solvers.py"),
        solvers="results/checks/solvers.nc",
    output:
        energy=files_of("results/figures/energy_drift"),
        agreement=files_of("results/figures/solver_agreement"),
    log:
        "results/logs/figures/solvers.log",
    conda:
        "../envs/pinned.yaml"
    params:
        differs=differs_of,
    message:
        "Drawing how the solvers conserve the energy, and until when they agree"
    script:
        "../../scripts/paper/draw_solvers.py"


rule measure_trust:
    "When the norms of each solver leave those of the reference, and until when curves are proved"
    input:
        code=code("paper/measure_trust.py"),
        trajectories=expand(
            "results/trajectories/{case}.{solver}.nc", case=PAPER_CASES, solver=ALL_SOLVERS
        ),
        references=references(*PAPER_CASES),
        decimal=references("fig4_small", "fig4_small.double"),
        proved=[*proved_curves(), *committed_proofs()],
    output:
        data="results/checks/trust.nc",
    log:
        "results/logs/checks/trust.log",
    conda:
        "../envs/pinned.yaml"
    params:
        cases=PAPER_CASES,
        solvers=ALL_SOLVERS,
        certified=[*SETTINGS.certified.curves.cases, *SETTINGS.certified.frames],
    message:
        "Measuring until when the trajectories can be trusted"
    script:
        "../../scripts/paper/measure_trust.py"


rule trust_horizons:
    "How long each solver stays with the true trajectory, that is with the reference"
    input:
        code=code("paper/draw_trust.py"),
        trust="results/checks/trust.nc",
    output:
        **figure("trust_horizons"),
    log:
        "results/logs/figures/trust_horizons.log",
    conda:
        "../envs/pinned.yaml"
    params:
        differs=differs_of,
    message:
        "Drawing until when each solver's trajectories can be trusted"
    script:
        "../../scripts/paper/draw_trust.py"


rule solver_table:
    "All that is measured of the solvers as tables to read: solvers.md, trust.md"
    input:
        code=code("paper/tabulate_solvers.py"),
        solvers="results/checks/solvers.nc",
        trust="results/checks/trust.nc",
    output:
        table="results/tables/solvers.md",
        trust_table="results/tables/trust.md",
    log:
        "results/logs/tables/solvers.log",
    conda:
        "../envs/pinned.yaml"
    message:
        "Tabling energy drift, agreement and errors of the solvers"
    script:
        "../../scripts/paper/tabulate_solvers.py"
