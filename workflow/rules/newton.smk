# Newton's equations (1) of the pendula, compared with the amplitude equations (4).
THRESHOLD, REMAINDER, OVER_THE_TOP = (
    getattr(SETTINGS.newton, name) for name in ("threshold", "remainder", "over_the_top")
)


use rule dataset as find_threshold with:
    "Lemma 1 for the pendula: the drive at which they lose stability"
    pathvars:
        made="pendula/threshold",
    params:
        **values_of(THRESHOLD, "epsilon", "omegas", "mus"),
        call=function("pendula.studies.newton.threshold.solve_thresholds"),


use rule dataset as measure_remainder with:
    "The error of the expansion (3) of the pendula"
    pathvars:
        made="pendula/remainder",
    params:
        call=function("pendula.studies.newton.remainder.measure_remainder"),
        mus=REMAINDER.mus,
        problems=SETTINGS.runs_of_cases(
            PAPER_CASES, **values_of(REMAINDER, "tolerance", "end_time", "output_step")
        ),


use rule dataset as measure_over_the_top with:
    "When pendula go over the top, and with which probability"
    input:
        kernels("taylor"),
        chunks=chunks_of("{size}pendula/over_the_top"),
    pathvars:
        made="<size>pendula/over_the_top<chunk>",
    resources:
        **resources_for(cost_of_study),
    params:
        **values_of(OVER_THE_TOP, "size", "seed", "settled"),
        **by_size(OVER_THE_TOP, "mus", "members"),
        call=function("pendula.studies.newton.over_the_top.measure_over_the_top"),
        problem=lambda wildcards: run_of(
            **values_of(OVER_THE_TOP, "case", "tolerance"),
            **values_of(section_of_size(OVER_THE_TOP, wildcards), "end_time"),
        ),


use rule dataset as vary_over_the_top with:
    "The article's numbers on pendula over the top, measured again with each choice changed"
    input:
        kernels("taylor"),
    pathvars:
        made="long/pendula/varied",
    resources:
        **resources_for(long_study),
    params:
        **values_of(OVER_THE_TOP.long),
        call=function("pendula.studies.newton.over_the_top.vary_over_the_top"),
        problem=run_of(**values_of(OVER_THE_TOP, "case", "tolerance")),
        chosen=values_of(OVER_THE_TOP, "tolerance", "size", "seed", "settled"),


use rule figure as draw_over_the_top with:
    "First passages of the pendula over the top"
    input:
        over_the_top="<results>/{size}pendula/over_the_top.nc",
    pathvars:
        made="<size>figures/pendula_over_the_top",
    params:
        call=function("pendula.studies.newton.figures.draw_over_the_top"),


rule newton:
    "Newton's equations compared with the amplitude equations: datasets and figure"
    input:
        datasets=datasets("pendula", "threshold", "remainder", "over_the_top"),
        figure="<results>/figures/pendula_over_the_top.png",
