# The infinite chain: does its l2 norm grow without bound in time? The short study is part of the full run,
# `snakemake unbounded` runs the long one.
from pendula.studies.unbounded.settings import GROWTH_CASES

UNBOUNDED = SETTINGS.unbounded


rule unbounded:
    "The long study of the infinite chain (takes about ten minutes): results/long/"
    input:
        datasets("long/unbounded", *UNBOUNDED.names, "fronts", "transverse", "noise", "numbers"),
        expand("<results>/long/figures/{name}.png", name=["growth_law", "fronts"]),


use rule dataset as spread with:
    "An ensemble on the infinite chain: results/unbounded/{study}.nc"
    input:
        chunks=chunks_of("{size}unbounded/{study}"),
    pathvars:
        made=f"<size>unbounded/{{study,{any_of(UNBOUNDED.names)}}}<chunk>",
    resources:
        **resources_for(cost_of_study),
    params:
        **values_of(UNBOUNDED, "perturbation", "seed"),
        call=function("pendula.studies.unbounded.long_runs.spread_case"),
        name="{study}",
        problems=lambda wildcards: UNBOUNDED.problems(
            SETTINGS.problem(UNBOUNDED.case_of(wildcards.study)),
            wildcards.study,
            section_of_size(UNBOUNDED, wildcards),
        ),
        rest_threshold=lambda wildcards: section_of_size(UNBOUNDED, wildcards).rest_threshold,
        members=lambda wildcards: section_of_size(UNBOUNDED, wildcards)
        .runs[wildcards.study]
        .members,
        levels=lambda wildcards: UNBOUNDED.long.levels if wildcards.size else None,
        edges=lambda wildcards: UNBOUNDED.long.edges if wildcards.size else None,


use rule spread as spread_again with:
    "The long study with a coarser tolerance: results/long/coarse/unbounded/{study}.nc"
    input:
        chunks=chunks_of("long/coarse/unbounded/{study}"),
    pathvars:
        made="long/coarse/unbounded/{study,omegas|fig3_large}<chunk>",
    resources:
        **resources_for(long_study),
    params:
        **values_of(UNBOUNDED.long, "levels", "edges"),
        problems=lambda wildcards: UNBOUNDED.problems(
            SETTINGS.problem(UNBOUNDED.case_of(wildcards.study)),
            wildcards.study,
            UNBOUNDED.long.made_coarsely,
        ),
        rest_threshold=UNBOUNDED.long.rest_threshold,
        members=lambda wildcards: UNBOUNDED.long.runs[wildcards.study].members,


use rule dataset as run_transverse with:
    "The growth of a small A + B if A = -B initially, and the speed of the second front that follows"
    input:
        chunks=chunks_of("long/unbounded/transverse"),
    pathvars:
        made="long/unbounded/transverse<chunk>",
    resources:
        **resources_for(long_study),
    params:
        **values_of(UNBOUNDED.long.transverse, "members", "tolerances", "perturbations"),
        call=function("pendula.studies.unbounded.transverse.solve_transverse"),
        problems=UNBOUNDED.timed(
            SETTINGS.problem(UNBOUNDED.omegas.case),
            UNBOUNDED.omegas.values,
            UNBOUNDED.long.transverse.end_times(UNBOUNDED.omegas.values),
        ),
        rest_threshold=UNBOUNDED.long.rest_threshold,
        seed=UNBOUNDED.seed,


use rule dataset as run_noise with:
    "The second front if noise makes A + B grow"
    input:
        chunks=chunks_of("long/unbounded/noise"),
    pathvars:
        made="long/unbounded/noise<chunk>",
    resources:
        **resources_for(long_study),
    params:
        **values_of(UNBOUNDED.long.noise, "members", "tolerances"),
        **values_of(UNBOUNDED, "perturbation", "seed"),
        call=function("pendula.studies.unbounded.noise.follow_noise"),
        problems=UNBOUNDED.timed(
            SETTINGS.problem(UNBOUNDED.omegas.case),
            UNBOUNDED.long.noise.omegas,
            UNBOUNDED.long.noise.end_times,
        ),
        noises=UNBOUNDED.long.noise.sizes,
        rest_threshold=UNBOUNDED.long.rest_threshold,


use rule dataset as vary_numbers with:
    "The numbers of the long study, each measured again with its choices changed"
    input:
        omegas="<results>/long/unbounded/omegas.nc",
        omegas_coarse="<results>/long/coarse/unbounded/omegas.nc",
        large="<results>/long/unbounded/fig3_large.nc",
        large_coarse="<results>/long/coarse/unbounded/fig3_large.nc",
        thermal="<results>/unbounded/thermal.nc",
        transverse="<results>/long/unbounded/transverse.nc",
        noise="<results>/long/unbounded/noise.nc",
    pathvars:
        made="long/unbounded/numbers",
    params:
        call=function("pendula.studies.unbounded.variations.vary_numbers"),


use rule dataset as thermal with:
    "The thermal states with which the bulk of an infinite chain is compared"
    pathvars:
        made="unbounded/thermal",
    params:
        **values_of(SETTINGS.cases["fig4_small"], "epsilon", "gamma"),
        call=function("pendula.studies.unbounded.thermal.solve_thermal"),
        omegas=UNBOUNDED.omegas.values,
        nodes=UNBOUNDED.nodes,


use rule dataset as measure_fronts with:
    "The infinite chain: the speeds of its fronts, and the states behind them"
    input:
        omegas="<results>/{size}unbounded/omegas.nc",
        thermal="<results>/unbounded/thermal.nc",
    pathvars:
        made="<size>unbounded/fronts",
    params:
        call=function("pendula.studies.unbounded.measured.measure_fronts"),


use rule figure as draw_growth_law with:
    "The infinite chain: norms against time, and the law that they follow"
    input:
        runs=expand("<results>/{{size}}unbounded/{case}.nc", case=GROWTH_CASES),
        thermal="<results>/unbounded/thermal.nc",
    pathvars:
        made="<size>figures/growth_law",
    params:
        call=function("pendula.studies.unbounded.figures.draw_growth_law"),


use rule figure as draw_fronts with:
    "The infinite chain: its two fronts, and the states behind them"
    input:
        fronts="<results>/{size}unbounded/fronts.nc",
    pathvars:
        made="<size>figures/fronts",
    params:
        call=function("pendula.studies.unbounded.figures.draw_fronts"),
        # the committed numbers of `snakemake unbounded`, which include the predicted speeds
        long=committed("tests/baseline/quoted/unbounded.nc"),
