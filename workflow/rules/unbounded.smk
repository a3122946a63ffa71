# The chain without ends: does its l2 norm grow without bound in time? The short study is part of
# the full run, the long one is `snakemake unbounded`.
LONG = "results/unbounded/long"
GROWTH_CASES = ["fig4_small", "fig3_large", "fig2_large", "fig3_small"]
UNBOUNDED_FIGURES = ["growth_law", "front", "window_map"]


rule unbounded:
    "The long study of the chain without ends (takes about ten minutes)"
    input:
        expand(f"{LONG}/{{name}}.nc", name=[*SETTINGS.unbounded.names, *map_names()]),
        expand(f"{LONG}/{{name}}.{{kind}}", name=UNBOUNDED_FIGURES, kind=["png", "pdf"]),
    message:
        "The long study of the chain without ends is there"


rule spread:
    "An ensemble on the chain without ends: results/unbounded/{study}.nc"
    input:
        code=code("unbounded/spread_case.py"),
        kernels=kernels(SETTINGS.unbounded.short.solver.name),
    output:
        data="results/unbounded/{study}.nc",
    log:
        "results/logs/unbounded/{study}.log",
    wildcard_constraints:
        study=one_of(SETTINGS.unbounded.names),
    conda:
        "../envs/pinned.yaml"
    params:
        **run_params(SETTINGS.unbounded.short),
    message:
        "Spreading on the chain without ends: {wildcards.study}"
    script:
        "../../scripts/unbounded/spread_case.py"


use rule spread as long_spread with:
    "The same for longer times: results/unbounded/long/{study}.nc"
    input:
        code=code("unbounded/spread_case.py"),
        kernels=kernels(SETTINGS.unbounded.long.solver.name),
    output:
        data=f"{LONG}/{{study}}.nc",
    log:
        "results/logs/unbounded/long/{study}.log",
    params:
        **run_params(SETTINGS.unbounded.long),
        checkpoints=f"{LONG}/checkpoints",
    message:
        "Spreading for long on the chain without ends: {wildcards.study}"


rule map_windows:
    "Maxima over half-widths and windows, for a sweep: results/unbounded/map_{sweep}.nc"
    input:
        code=code("unbounded/map_windows.py"),
        kernels=kernels(SETTINGS.unbounded.short.solver.name),
    output:
        data="results/unbounded/map_{sweep}.nc",
    log:
        "results/logs/unbounded/map_{sweep}.log",
    wildcard_constraints:
        sweep=one_of(PAPER_SWEEPS),
    conda:
        "../envs/pinned.yaml"
    params:
        **map_params(SETTINGS.unbounded.short),
    message:
        "Maxima over half-widths and windows: {wildcards.sweep}"
    script:
        "../../scripts/unbounded/map_windows.py"


use rule map_windows as long_map_windows with:
    "The same for longer times: results/unbounded/long/map_{sweep}.nc"
    input:
        code=code("unbounded/map_windows.py"),
        kernels=kernels(SETTINGS.unbounded.long.solver.name),
    output:
        data=f"{LONG}/map_{{sweep}}.nc",
    log:
        "results/logs/unbounded/long/map_{sweep}.log",
    params:
        **map_params(SETTINGS.unbounded.long),
    message:
        "Maxima over many half-widths and long windows: {wildcards.sweep}"


rule thermal:
    "The thermal states that the bulk of a chain without ends is compared with"
    input:
        code=code("unbounded/solve_thermal.py"),
    output:
        data="results/unbounded/thermal.nc",
    log:
        "results/logs/unbounded/thermal.log",
    conda:
        "../envs/pinned.yaml"
    params:
        epsilon=SETTINGS.cases["fig4_small"].epsilon,
        gamma=SETTINGS.cases["fig4_small"].gamma,
        omegas=SETTINGS.unbounded.thermal.omegas,
        bulk_omega=SETTINGS.cases["fig4_small"].omega,
        warm_omega=SETTINGS.cases[SETTINGS.unbounded.thermal.warm.case].omega,
        energies=SETTINGS.unbounded.thermal.warm.energies,
        nodes=SETTINGS.unbounded.thermal.nodes,
        density_nodes=SETTINGS.unbounded.thermal.density_nodes,
    message:
        "Solving the thermal states that the bulk is compared with"
    script:
        "../../scripts/unbounded/solve_thermal.py"


rule measure_growth:
    "The chain without ends: growth laws of the norms, speeds of the front, the bulk behind it"
    input:
        **growth_inputs("results/unbounded"),
        code=code("unbounded/measure_growth.py"),
    output:
        growth="results/unbounded/growth.nc",
        front="results/unbounded/front.nc",
    log:
        "results/logs/unbounded/growth.log",
    conda:
        "../envs/pinned.yaml"
    params:
        cases=GROWTH_CASES,
    message:
        "Measuring the growth on the chain without ends"
    script:
        "../../scripts/unbounded/measure_growth.py"


use rule measure_growth as long_measure_growth with:
    "The growth laws, fronts and bulk of the long study"
    input:
        **growth_inputs(LONG),
        code=code("unbounded/measure_growth.py"),
    output:
        growth=f"{LONG}/growth.nc",
        front=f"{LONG}/front.nc",
    log:
        "results/logs/unbounded/long/growth.log",


rule growth_law:
    "The chain without ends: norms against time, and the exponents of time that they follow"
    input:
        code=code("unbounded/draw_growth_law.py"),
        growth="results/unbounded/growth.nc",
    output:
        **figure("growth_law"),
    log:
        "results/logs/figures/growth_law.log",
    conda:
        "../envs/pinned.yaml"
    params:
        differs=differs_of,
    message:
        "Drawing the growth law of the chain without ends"
    script:
        "../../scripts/unbounded/draw_growth_law.py"


use rule growth_law as long_growth_law with:
    "The figure growth_law of the long study"
    input:
        code=code("unbounded/draw_growth_law.py"),
        growth=f"{LONG}/growth.nc",
    output:
        **long_figure("growth_law"),
    log:
        "results/logs/figures/long_growth_law.log",


rule front:
    "The chain without ends: the speed of the front, and the bulk behind it"
    input:
        code=code("unbounded/draw_front.py"),
        front="results/unbounded/front.nc",
    output:
        **figure("front"),
    log:
        "results/logs/figures/front.log",
    conda:
        "../envs/pinned.yaml"
    params:
        differs=differs_of,
    message:
        "Drawing the front on the chain without ends"
    script:
        "../../scripts/unbounded/draw_front.py"


use rule front as long_front with:
    "The figure front of the long study"
    input:
        code=code("unbounded/draw_front.py"),
        front=f"{LONG}/front.nc",
    output:
        **long_figure("front"),
    log:
        "results/logs/figures/long_front.log",


rule window_map:
    "Maxima over windows [10, T] on chains of half-width M: the map over (M, T)"
    input:
        code=code("unbounded/draw_window_map.py"),
        maps=expand("results/unbounded/{name}.nc", name=map_names()),
    output:
        **figure("window_map"),
    log:
        "results/logs/figures/window_map.log",
    conda:
        "../envs/pinned.yaml"
    params:
        differs=differs_of,
        sweeps=PAPER_SWEEPS,
        paper_ends=[paper()["sweeps"][sweep]["draw"]["max"][1] for sweep in PAPER_SWEEPS],
    message:
        "Drawing the maxima over half-widths and windows"
    script:
        "../../scripts/unbounded/draw_window_map.py"


use rule window_map as long_window_map with:
    "The figure window_map of the long study"
    input:
        code=code("unbounded/draw_window_map.py"),
        maps=expand(f"{LONG}/{{name}}.nc", name=map_names()),
    output:
        **long_figure("window_map"),
    log:
        "results/logs/figures/long_window_map.log",
