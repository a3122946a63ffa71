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
    message:
        "Finding steady breathers"


use rule dataset as periodic_breathers with:
    input:
        kernels=kernels("taylor"),
    "Periodic motions localised at one pair, and how fast their perturbations grow"
    pathvars:
        made="breathers/periodic",
    params:
        **values_of(BREATHERS, "epsilon", "gamma"),
        **values_of(BREATHERS.periodic),
        call=function("pendula.studies.breathers.periodic_contents.periodic_contents"),
    message:
        "Finding periodic breathers"


use rule periodic_breathers as perturbed_breathers with:
    "How stable breathers move after a change, for thousands of periods: results/long/breathers/"
    pathvars:
        made="long/breathers/perturbed",
    params:
        **values_of(BREATHERS.periodic.long),
        call=function("pendula.studies.breathers.periodic_contents.perturbed_contents"),
    message:
        "Following changed breathers for thousands of periods"


use rule dataset as growth_by_drive with:
    input:
        kernels=kernels("taylor"),
    "How the drive feeds a localised motion, beside the law of weak drives"
    pathvars:
        made="breathers/growth",
    params:
        **values_of(BREATHERS.growth),
        call=function("pendula.studies.breathers.contents.growth_contents"),
        epsilon=BREATHERS.epsilon,
    message:
        "Measuring how a localised motion grows by the drive"


use rule dataset as measure_sensitivity with:
    input:
        kernels=kernels("taylor"),
    "Which of almost equal data spread over the chain"
    pathvars:
        made="<size>breathers/sensitivity",
    params:
        **values_of(BREATHERS.sensitivity, "sizes", "seed"),
        call=function("pendula.studies.breathers.contents.sensitivity_contents"),
        name=BREATHERS.sensitivity.case,
        problem=run_of(**values_of(BREATHERS.sensitivity, "case", "tolerance", "end_time")),
        given=sized(BREATHERS.sensitivity, "members", "scan"),
    message:
        "Measuring which of almost equal data spread"


use rule dataset as map_fates with:
    input:
        kernels=kernels("taylor"),
        periodic="<results>/breathers/periodic.nc",
        fine=lambda wildcards: [] if wildcards.size else committed(FINE_MAPS),
    "What becomes of data on one pair: they disperse, stay, move or spread"
    pathvars:
        made="<size>breathers/fates",
    params:
        call=function("pendula.studies.breathers.fate_contents.map_fates"),
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
    message:
        "Mapping what becomes of data on one pair"


use rule figure as draw_breathers with:
    input:
        periodic="<results>/breathers/periodic.nc",
        growth="<results>/breathers/growth.nc",
    "Periodic breathers against their frequency, and how the drive feeds a localised motion"
    pathvars:
        made="figures/breathers",
    params:
        call=function("pendula.studies.breathers.figures.draw_breathers"),
    message:
        "Drawing breathers and their growth by the drive"


use rule figure as draw_sensitivity with:
    input:
        sensitivity="<results>/{size}breathers/sensitivity.nc",
    "Which of almost equal data spread over the chain, as a picture"
    pathvars:
        made="<size>figures/sensitivity",
    params:
        call=function("pendula.studies.breathers.figures.draw_sensitivity"),
    message:
        "Drawing which of almost equal data spread"


use rule figure as draw_fates with:
    input:
        fates="<results>/{size}breathers/fates.nc",
        fine=lambda wildcards: [] if wildcards.size else committed(FINE_MAPS),
    "What becomes of data on one pair, as a map"
    pathvars:
        made="<size>figures/fates",
    params:
        call=function("pendula.studies.breathers.fate_figures.draw_fates"),
    message:
        "Drawing what becomes of data on one pair"


rule breathers:
    "States that stay at one pair, which data reach them, and which spread: datasets and figures"
    input:
        expand("<results>/breathers/{name}.nc", name=BREATHERS_PARTS),
        expand("<results>/figures/{name}.png", name=["breathers", "sensitivity", "fates"]),
    message:
        "The breathers and their figures are there"


rule sensitivity:
    "Which of almost equal data spread, with many members and a long scan: results/long/figures/"
    input:
        files_of("<results>/long/figures/sensitivity"),
    message:
        "The long study of sensitivity is there"


rule fates:
    "The map of fates on a fine grid, which takes minutes: results/long/figures/"
    input:
        files_of("<results>/long/figures/fates"),
    message:
        "The map of fates is there"
