# Breathers: states that stay at one pair, what becomes of data there, and which of them spread.
BREATHERS = SETTINGS.breathers
FATES = BREATHERS.fates
RUN_OF_FATES = {
    **values_of(FATES, "tolerance", "half_width", "end_time"),
    "output_step": FATES.end_time,
}


use rule dataset as steady_breathers with:
    "Steady states localised at one pair: families, where they are born, where they are stable"
    pathvars:
        made="breathers/steady",
    params:
        **values_of(BREATHERS, "epsilon", "gamma"),
        **values_of(BREATHERS.steady),
        call=function("pendula.studies.breathers.contents.steady_contents"),


use rule dataset as periodic_breathers with:
    "Periodic motions localised at one pair, and how fast their perturbations grow"
    input:
        kernels=kernels("taylor"),
    pathvars:
        made="breathers/periodic",
    params:
        **values_of(BREATHERS, "epsilon", "gamma"),
        **values_of(BREATHERS.periodic),
        call=function("pendula.studies.breathers.periodic_contents.periodic_contents"),


use rule dataset as growth_by_drive with:
    "How the drive feeds a localised motion, beside the law of weak drives"
    input:
        kernels=kernels("taylor"),
    pathvars:
        made="breathers/growth",
    params:
        **values_of(BREATHERS.growth),
        call=function("pendula.studies.breathers.driven_growth.growth_contents"),
        epsilon=BREATHERS.epsilon,


use rule dataset as measure_sensitivity with:
    "Share of runs that spread, by the size of a random change of the data"
    input:
        kernels=kernels("taylor"),
    pathvars:
        made="<size>breathers/sensitivity",
    params:
        **values_of(BREATHERS.sensitivity, "sizes", "seed"),
        call=function("pendula.studies.breathers.sensitivity.sensitivity_contents"),
        name=BREATHERS.sensitivity.case,
        problem=run_of(**values_of(BREATHERS.sensitivity, "case", "tolerance", "end_time")),
        given=sized(BREATHERS.sensitivity, "members", "scan"),


use rule dataset as map_fates with:
    "What becomes of data on one pair: they disperse, stay, move or spread"
    input:
        kernels=kernels("taylor"),
        periodic="<results>/breathers/periodic.nc",
    pathvars:
        made="<size>breathers/fates",
    params:
        call=function("pendula.studies.breathers.fate_contents.map_fates"),
        committed=fine_maps,
        problems={
            omega: run_of(
                "fig4_small",
                omega=omega,
                **values_of(BREATHERS, "epsilon", "gamma"),
                **RUN_OF_FATES,
            )
            for omega in FATES.omegas
        },
        case_problems={case: run_of(case, **RUN_OF_FATES) for case in cases_on_one_pair()},
        given=lambda wildcards: FATES.grid(FATES.long if wildcards.size else FATES),


use rule figure as draw_breathers with:
    "Periodic breathers against their frequency, and how the drive feeds a localised motion"
    input:
        periodic="<results>/breathers/periodic.nc",
        growth="<results>/breathers/growth.nc",
    pathvars:
        made="figures/breathers",
    params:
        call=function("pendula.studies.breathers.figures.draw_breathers"),


use rule figure as draw_sensitivity with:
    "Share of runs that spread, as a figure"
    input:
        sensitivity="<results>/{size}breathers/sensitivity.nc",
    pathvars:
        made="<size>figures/sensitivity",
    params:
        call=function("pendula.studies.breathers.figures.draw_sensitivity"),


use rule figure as draw_fates with:
    "Maps of what becomes of initial conditions on one pair"
    input:
        fates="<results>/{size}breathers/fates.nc",
    pathvars:
        made="<size>figures/fates",
    params:
        call=function("pendula.studies.breathers.figures.draw_fates"),
        committed=fine_maps,


rule breathers:
    "States that stay at one pair, which data reach them, and which spread: datasets and figures"
    input:
        datasets=datasets("breathers", "steady", "periodic", "growth", "sensitivity", "fates"),
        figures=expand("<results>/figures/{name}.png", name=["breathers", "sensitivity", "fates"]),
