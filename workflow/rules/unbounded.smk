# The chain without ends: does its l2 norm grow without bound in time? The short study is part of
# the full run, the long one is `snakemake unbounded`.

LONG = "results/unbounded/long"
GROWTH_CASES = ["fig4_small", "fig3_large", "fig2_large", "fig3_small"]


rule unbounded:
    "The long study of the chain without ends (takes about ten minutes)"
    input:
        expand(f"{LONG}/{{name}}.nc", name=[*STUDIES, *map_names()]),
        expand(f"{LONG}/{{name}}.{{kind}}", name=UNBOUNDED_FIGURES, kind=["png", "pdf"]),
        f"{LONG}/scale.md",


rule spread:
    input:
        code=code("unbounded/spread_case.py"),
        kernels=kernels("dop853"),
    output:
        data="results/unbounded/{study}.nc",
    log:
        "results/logs/unbounded/{study}.log",
    wildcard_constraints:
        study=one_of(STUDIES),
    priority: 8
    conda:
        "../envs/pinned.yaml"
    params:
        name="{study}",
        problems=lambda wildcards: unbounded_problems(wildcards.study, SETTINGS.unbounded),
        rest=REST[SETTINGS.unbounded],
        members=lambda wildcards: SPREADS[SETTINGS.unbounded][wildcards.study][1],
    message:
        "Spreading on the chain without ends: {wildcards.study}"
    script:
        "../../scripts/unbounded/spread_case.py"


use rule spread as long_spread with:
    output:
        data=f"{LONG}/{{study}}.nc",
    log:
        "results/logs/unbounded/long/{study}.log",
    params:
        name="{study}",
        problems=lambda wildcards: unbounded_problems(wildcards.study, "long"),
        rest=REST["long"],
        members=lambda wildcards: SPREADS["long"][wildcards.study][1],
        checkpoints=f"{LONG}/checkpoints",
    message:
        "Spreading for long on the chain without ends: {wildcards.study}"


rule map_windows:
    input:
        code=code("unbounded/map_windows.py"),
        kernels=kernels("dop853"),
    output:
        data="results/unbounded/map_{sweep}.nc",
    log:
        "results/logs/unbounded/map_{sweep}.log",
    wildcard_constraints:
        sweep=one_of(PAPER_SWEEPS),
    priority: 8
    conda:
        "../envs/pinned.yaml"
    params:
        **map_params(SETTINGS.unbounded),
    message:
        "Maxima over half-widths and windows: {wildcards.sweep}"
    script:
        "../../scripts/unbounded/map_windows.py"


use rule map_windows as long_map_windows with:
    output:
        data=f"{LONG}/map_{{sweep}}.nc",
    log:
        "results/logs/unbounded/long/map_{sweep}.log",
    params:
        **map_params("long"),
    message:
        "Maxima over many half-widths and long windows: {wildcards.sweep}"


rule thermal:
    input:
        code=code("unbounded/sample_thermal.py"),
    output:
        data="results/unbounded/thermal.nc",
    log:
        "results/logs/unbounded/thermal.log",
    priority: 8
    conda:
        "../envs/pinned.yaml"
    params:
        epsilon=SETTINGS.cases["fig4_small"].epsilon,
        gamma=SETTINGS.cases["fig4_small"].gamma,
        omegas=THERMAL[SETTINGS.unbounded],
    message:
        "Sampling the thermal states without energy"
    script:
        "../../scripts/unbounded/sample_thermal.py"


rule scale:
    input:
        code=code("unbounded/measure_scale.py"),
        kernels=kernels("dop853"),
    output:
        data=f"{LONG}/scale.nc",
        table=f"{LONG}/scale.md",
    log:
        "results/logs/unbounded/long/scale.log",
    conda:
        "../envs/pinned.yaml"
    threads: workflow.cores
    message:
        "Timing windows of up to a million sites"
    script:
        "../../scripts/unbounded/measure_scale.py"


rule growth_law:
    "The chain without ends: norms against time, and the powers of time that they follow"
    input:
        code=code("unbounded/draw_growth_law.py"),
        runs=expand("results/unbounded/{case}.nc", case=GROWTH_CASES),
        thermal="results/unbounded/thermal.nc",
    output:
        **figure("growth_law"),
    log:
        "results/logs/figures/growth_law.log",
    conda:
        "../envs/pinned.yaml"
    params:
        cases=GROWTH_CASES,
    message:
        "Drawing the growth law of the chain without ends"
    script:
        "../../scripts/unbounded/draw_growth_law.py"


use rule growth_law as long_growth_law with:
    input:
        code=code("unbounded/draw_growth_law.py"),
        runs=expand(f"{LONG}/{{case}}.nc", case=GROWTH_CASES),
        thermal="results/unbounded/thermal.nc",
    output:
        **long_figure("growth_law"),
    log:
        "results/logs/figures/long_growth_law.log",


rule front:
    "The chain without ends: the speed of the front, and the state behind it"
    input:
        code=code("unbounded/draw_front.py"),
        omegas="results/unbounded/omegas.nc",
        sea="results/unbounded/fig4_small.nc",
        large="results/unbounded/fig3_large.nc",
        thermal="results/unbounded/thermal.nc",
    output:
        **figure("front"),
    log:
        "results/logs/figures/front.log",
    conda:
        "../envs/pinned.yaml"
    message:
        "Drawing the front on the chain without ends"
    script:
        "../../scripts/unbounded/draw_front.py"


use rule front as long_front with:
    input:
        code=code("unbounded/draw_front.py"),
        omegas=f"{LONG}/omegas.nc",
        sea=f"{LONG}/fig4_small.nc",
        large=f"{LONG}/fig3_large.nc",
        thermal="results/unbounded/thermal.nc",
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
        sweeps=PAPER_SWEEPS,
    message:
        "Drawing the maxima over half-widths and windows"
    script:
        "../../scripts/unbounded/draw_window_map.py"


use rule window_map as long_window_map with:
    input:
        code=code("unbounded/draw_window_map.py"),
        maps=expand(f"{LONG}/{{name}}.nc", name=map_names()),
    output:
        **long_figure("window_map"),
    log:
        "results/logs/figures/long_window_map.log",
