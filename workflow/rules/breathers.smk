# Breathers: states that stay at one pair, the fates of initial data there, and which of these spread.
BREATHERS = SETTINGS.breathers
FINE_MAPS = committed("tests/baseline/quoted/breathers.nc")
FATES = BREATHERS.fates
RUN_OF_FATES = {
    **values_of(FATES, "tolerance", "half_width", "end_time"),
    "output_step": FATES.end_time,
}
CHOSEN = {"majority": 0.5}


use rule dataset as steady_breathers with:
    "Families of steady states localised at one pair: where they begin, and where they are stable"
    pathvars:
        made="breathers/steady",
    params:
        **values_of(BREATHERS, "epsilon", "gamma"),
        **values_of(BREATHERS.steady),
        call=function("pendula.studies.breathers.contents.solve_steady_states"),


use rule dataset as periodic_breathers with:
    "Periodic states localised at one pair, and how fast their perturbations grow"
    pathvars:
        made="breathers/periodic",
    params:
        **values_of(BREATHERS, "epsilon", "gamma"),
        **values_of(BREATHERS.periodic),
        call=function("pendula.studies.breathers.contents.solve_periodic_breathers"),


use rule dataset as measure_sensitivity with:
    "Share of runs that spread, by the size of a random perturbation of the initial data"
    input:
        kernels("taylor"),
        chunks=chunks_of("{size}breathers/sensitivity"),
    pathvars:
        made="<size>breathers/sensitivity<chunk>",
    resources:
        **resources_for(cost_of_study),
    params:
        **values_of(BREATHERS.sensitivity, "sizes", "seed"),
        **by_size(BREATHERS.sensitivity, "members"),
        call=function("pendula.studies.breathers.sensitivity.measure_sensitivity"),
        name=BREATHERS.sensitivity.case,
        problem=run_of(**values_of(BREATHERS.sensitivity, "case", "tolerance", "end_time")),


use rule dataset as map_fates with:
    "Fates of initial data on one pair: they disperse, stay, move or spread"
    input:
        kernels("taylor"),
        chunks=chunks_of("{size}breathers/fates"),
    pathvars:
        made="<size>breathers/fates<chunk>",
    resources:
        **resources_for(cost_of_study),
    params:
        call=function("pendula.studies.breathers.fates.map_fates"),
        problems={
            omega: run_of(
                "fig4_small",
                omega=omega,
                **values_of(BREATHERS, "epsilon", "gamma"),
                **RUN_OF_FATES,
            )
            for omega in FATES.omegas
        },
        amplitudes=lambda wildcards: FATES.amplitudes(section_of_size(FATES, wildcards).points),


use rule dataset as vary_areas with:
    "The area of each fate at Omega = -4, measured again with each choice changed"
    input:
        kernels("taylor"),
    pathvars:
        made="long/breathers/areas",
    resources:
        **resources_for(long_study),
    params:
        call=function("pendula.studies.breathers.other_choices.vary_areas"),
        problem=run_of("fig3_large", **values_of(BREATHERS, "epsilon", "gamma"), **RUN_OF_FATES),
        amplitudes=FATES.amplitudes(FATES.long.points),
        chosen=CHOSEN | values_of(FATES, "tolerance", "end_time", "half_width") | {"stride": 1},
        variations=FATES.long.variations,


use rule dataset as vary_shares with:
    "Share of runs that spread, measured again with each choice changed"
    input:
        kernels("taylor"),
    pathvars:
        made="long/breathers/shares",
    resources:
        **resources_for(long_study),
    params:
        **values_of(BREATHERS.sensitivity, "sizes"),
        **values_of(BREATHERS.sensitivity.long),
        call=function("pendula.studies.breathers.other_choices.vary_shares"),
        name=BREATHERS.sensitivity.case,
        problem=run_of(**values_of(BREATHERS.sensitivity, "case", "tolerance", "end_time")),
        chosen=CHOSEN
        | values_of(BREATHERS.sensitivity, "tolerance", "end_time", "seed")
        | {"half_width": SETTINGS.cases[BREATHERS.sensitivity.case].half_width},


use rule dataset as vary_least_power with:
    "The least P of breathers at Omega = -4, measured again with each choice changed"
    pathvars:
        made="long/breathers/least_power",
    resources:
        **resources_for(long_study),
    params:
        **values_of(BREATHERS.periodic.long, "frequencies", "variations"),
        call=function("pendula.studies.breathers.other_choices.vary_least_power"),
        constants=values_of(BREATHERS, "epsilon", "gamma")
        | values_of(BREATHERS.periodic.long, "omega"),
        chosen=values_of(BREATHERS.periodic, "half_width")
        | values_of(BREATHERS.periodic.long, "frequency_step")
        | {"steps": 40},


use rule figure as draw_fates with:
    "A map of the fates of initial data on one pair"
    input:
        fates="<results>/{size}breathers/fates.nc",
    pathvars:
        made="<size>figures/fates",
    params:
        call=function("pendula.studies.breathers.figures.draw_fates"),
        # the committed maps of `snakemake fates`, unless this command draws its own
        fine=lambda wildcards: None if wildcards.size else FINE_MAPS,


rule breathers:
    "States that stay at one pair, and which initial data stay or spread: datasets and a figure"
    input:
        datasets=datasets("breathers", "steady", "periodic", "sensitivity", "fates"),
        figures=figure_files("<results>/figures/fates"),
