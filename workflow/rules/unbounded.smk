# The infinite chain: does its l2 norm grow without bound in time? The short study is part of
# the full run, the long one is `snakemake unbounded`.
UNBOUNDED = SETTINGS.unbounded
GROWTH_CASES = ["fig4_small", "fig3_large", "fig2_large", "fig3_small"]
MAPS = [f"map_{sweep}" for sweep in PAPER_SWEEPS]


rule unbounded:
    "The long study of the infinite chain (takes about ten minutes): results/long/"
    input:
        datasets("long/unbounded", *UNBOUNDED.names, *MAPS),
        expand("<results>/long/figures/{name}.png", name=["growth_law", "front", "window_map"]),


use rule dataset as spread with:
    "An ensemble on the infinite chain: results/unbounded/{study}.nc"
    input:
        kernels=lambda wildcards: kernels(extent(wildcards).solver.name),
    pathvars:
        made=f"<size>unbounded/{{study,{one_of(UNBOUNDED.names)}}}",
    params:
        **values_of(UNBOUNDED, "perturbation", "seed"),
        call=function("pendula.studies.unbounded.long_runs.spread_case"),
        name="{study}",
        problems=lambda wildcards: UNBOUNDED.problems(
            SETTINGS.problem(UNBOUNDED.case_of(wildcards.study)),
            wildcards.study,
            extent(wildcards),
        ),
        rest=lambda wildcards: extent(wildcards).rest,
        members=lambda wildcards: extent(wildcards).runs[wildcards.study].members,


use rule dataset as map_windows with:
    "Maxima over half-widths and windows, for a sweep: results/unbounded/map_{sweep}.nc"
    input:
        kernels=lambda wildcards: kernels(extent(wildcards).solver.name),
    pathvars:
        made="<size>unbounded/map_<paper_sweep>",
    params:
        **values_of(UNBOUNDED, "perturbation", "seed"),
        call=function("pendula.studies.unbounded.long_runs.map_windows"),
        name="{sweep}",
        problem=lambda wildcards: UNBOUNDED.map_problem(
            SETTINGS.problem(SETTINGS.sweeps[wildcards.sweep].case), extent(wildcards)
        ),
        given=lambda wildcards: values_of(extent(wildcards).maps, "rest", "half_widths"),
        members=lambda wildcards: extent(wildcards).maps.members[wildcards.sweep],


use rule dataset as thermal with:
    "The thermal states that the bulk of an infinite chain is compared with"
    pathvars:
        made="unbounded/thermal",
    params:
        **values_of(SETTINGS.cases["fig4_small"], "epsilon", "gamma"),
        **values_of(UNBOUNDED.thermal, "omegas", "nodes", "density_nodes"),
        call=function("pendula.studies.unbounded.thermal.solve_thermal"),
        bulk_omega=SETTINGS.cases["fig4_small"].omega,
        warm_omega=SETTINGS.cases[UNBOUNDED.thermal.warm.case].omega,
        energies=UNBOUNDED.thermal.warm.energies,


use rule dataset as measure_growth with:
    "The infinite chain: growth laws of the norms, speeds of the front, the bulk behind it"
    input:
        runs=expand("<results>/{{size}}unbounded/{case}.nc", case=GROWTH_CASES),
        omegas="<results>/{size}unbounded/omegas.nc",
        bulk="<results>/{size}unbounded/fig4_small.nc",
        large="<results>/{size}unbounded/fig3_large.nc",
        thermal="<results>/unbounded/thermal.nc",
    output:
        "<results>/<size>unbounded/growth.nc",
        "<results>/<size>unbounded/front.nc",
    pathvars:
        made="<size>unbounded/growth",
    params:
        call=function("pendula.studies.unbounded.measured.measure"),


use rule figure as draw_growth_law with:
    "The infinite chain: norms against time, and the exponents of time that they follow"
    input:
        growth="<results>/{size}unbounded/growth.nc",
    pathvars:
        made="<size>figures/growth_law",
    params:
        call=function("pendula.studies.unbounded.figures.draw_growth_law"),


use rule figure as draw_front with:
    "The infinite chain: the speed of the front, and the bulk behind it"
    input:
        front="<results>/{size}unbounded/front.nc",
    pathvars:
        made="<size>figures/front",
    params:
        call=function("pendula.studies.unbounded.front_figure.draw_front"),


use rule figure as draw_window_map with:
    "Maxima over windows [10, T] on chains of half-width M: the map over (M, T)"
    input:
        maps=expand("<results>/{{size}}unbounded/{name}.nc", name=MAPS),
    pathvars:
        made="<size>figures/window_map",
    params:
        call=function("pendula.studies.unbounded.figures.draw_window_map"),
        sweeps=PAPER_SWEEPS,
        paper_ends=[paper()["sweeps"][sweep]["draw"]["max"][1] for sweep in PAPER_SWEEPS],
