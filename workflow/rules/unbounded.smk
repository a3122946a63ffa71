# The infinite chain: does its l2 norm grow without bound in time? The short study is part of
# the full run, the long one is `snakemake unbounded`.
from pendula.studies.unbounded.settings import GROWTH_CASES

UNBOUNDED = SETTINGS.unbounded


rule unbounded:
    "The long study of the infinite chain (takes about ten minutes): results/long/"
    input:
        datasets("long/unbounded", *UNBOUNDED.names, "fronts"),
        expand("<results>/long/figures/{name}.png", name=["growth_law", "fronts"]),


use rule dataset as spread with:
    "An ensemble on the infinite chain: results/unbounded/{study}.nc"
    input:
        chunks=parts_of("{size}unbounded/{study}"),
    pathvars:
        made=f"<size>unbounded/{{study,{one_of(UNBOUNDED.names)}}}",
    resources:
        **asked(cost_of_study),
    params:
        **values_of(UNBOUNDED, "perturbation", "seed"),
        call=function("pendula.studies.unbounded.long_runs.spread_case"),
        name="{study}",
        problems=lambda wildcards: UNBOUNDED.problems(
            SETTINGS.problem(UNBOUNDED.case_of(wildcards.study)),
            wildcards.study,
            of_size(UNBOUNDED, wildcards),
        ),
        rest=lambda wildcards: of_size(UNBOUNDED, wildcards).rest,
        members=lambda wildcards: of_size(UNBOUNDED, wildcards).runs[wildcards.study].members,


use rule dataset as thermal with:
    "The thermal states that the bulk of an infinite chain is compared with"
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
