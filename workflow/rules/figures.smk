# The paper's figures, and beside them where the chain moves.
# Every figure is written as PNG and PDF, with the data that it shows as netCDF.


rule fig1:
    "Fig 1: the chain of coupled pendula pairs"
    input:
        code=code("figures/draw_chain.py"),
    output:
        **figure("fig1"),
    log:
        "results/logs/figures/fig1.log",
    conda:
        "../envs/pinned.yaml"
    message:
        "Drawing Fig 1, the chain of pendula pairs"
    script:
        "../../scripts/figures/draw_chain.py"


rule fig2:
    "Figs 2, 3 and 4: norms against time at Omega = 8, -4 and 0"
    input:
        code=code("figures/draw_norms.py"),
        small="results/trajectories/fig2_small.nc",
        large="results/trajectories/fig2_large.nc",
        references=references("fig2_small", "fig2_large"),
    output:
        **figure("fig2"),
        **figure("fig2_spacetime", "spacetime_"),
    log:
        "results/logs/figures/fig2.log",
    conda:
        "../envs/pinned.yaml"
    message:
        "Drawing Fig 2, norms against time at Omega = 8"
    script:
        "../../scripts/figures/draw_norms.py"


use rule fig2 as fig3 with:
    input:
        code=code("figures/draw_norms.py"),
        small="results/trajectories/fig3_small.nc",
        large="results/trajectories/fig3_large.nc",
        references=references("fig3_small", "fig3_large"),
    output:
        **figure("fig3"),
        **figure("fig3_spacetime", "spacetime_"),
    log:
        "results/logs/figures/fig3.log",
    message:
        "Drawing Fig 3, norms against time at Omega = -4"


use rule fig2 as fig4 with:
    input:
        code=code("figures/draw_norms.py"),
        small="results/trajectories/fig4_small.nc",
        large="results/trajectories/fig4_large.nc",
        references=references("fig4_small", "fig4_large"),
    output:
        **figure("fig4"),
        **figure("fig4_spacetime", "spacetime_"),
    log:
        "results/logs/figures/fig4.log",
    message:
        "Drawing Fig 4, norms against time at Omega = 0"


rule fig5:
    "Figs 5 and 6: norms against half-width, for small and for large data"
    input:
        code=code("figures/draw_sweeps.py"),
        left="results/sweeps/fig5_left.nc",
        right="results/sweeps/fig5_right.nc",
    output:
        **figure("fig5"),
    log:
        "results/logs/figures/fig5.log",
    conda:
        "../envs/pinned.yaml"
    params:
        **drawn_windows("fig5_left"),
        norms=["l2", "linf"],
    message:
        "Drawing Fig 5, norms against half-width for small data"
    script:
        "../../scripts/figures/draw_sweeps.py"


use rule fig5 as fig6 with:
    input:
        code=code("figures/draw_sweeps.py"),
        left="results/sweeps/fig6_left.nc",
        right="results/sweeps/fig6_right.nc",
    output:
        **figure("fig6"),
    log:
        "results/logs/figures/fig6.log",
    params:
        **drawn_windows("fig6_left"),
        norms=["l2"],
    message:
        "Drawing Fig 6, norms against half-width for large data"
