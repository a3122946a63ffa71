# The pendula themselves, Newton's equations (1), beside the amplitude equations (4).
THRESHOLD, REMAINDER, SEA, OVER_THE_TOP = (
    getattr(SETTINGS.pendula, name) for name in ("threshold", "remainder", "sea", "over_the_top")
)


use rule dataset as find_threshold with:
    "Lemma 1 for the pendula: the drive at which they lose stability"
    pathvars:
        made="pendula/threshold",
    params:
        **values_of(THRESHOLD, "epsilon", "omegas", "mus"),
        call=function("pendula.studies.pendula.threshold.threshold_contents"),


use rule dataset as measure_remainder with:
    "How far the expansion (3) and its next order are from the pendula"
    pathvars:
        made="pendula/remainder",
    params:
        **values_of(REMAINDER, "end_step", "spacing"),
        call=function("pendula.studies.pendula.remainder.remainder_contents"),
        problems=followed(
            PAPER_CASES,
            REMAINDER.tolerance,
            end_time=REMAINDER.end_step,
            output_step=REMAINDER.end_step,
        ),
        run_ends=REMAINDER.run_ends,


use rule dataset as measure_sea with:
    "The state that fills the chain, of pendula beside that of the amplitudes"
    input:
        kernels=kernels("taylor"),
        chunks=parts_of("{size}pendula/sea"),
    pathvars:
        made="<size>pendula/sea",
    resources:
        **asked(cost_of_study),
    params:
        **values_of(SEA, "window", "size", "seed"),
        call=function("pendula.studies.pendula.chaotic_state.measure_sea"),
        problem=run_of(**values_of(SEA, "case", "tolerance", "output_step"), end_time=SEA.window[1]),
        given=sized(SEA, "mus", "members"),


use rule dataset as measure_over_the_top with:
    "When pendula go over the top, with what chance, and how far they turn then"
    input:
        kernels=kernels("taylor"),
        chunks=parts_of("{size}pendula/over_the_top"),
    pathvars:
        made="<size>pendula/over_the_top",
    resources:
        **asked(cost_of_study),
    params:
        **values_of(OVER_THE_TOP, "mus", "per_period", "size", "seed", "settled"),
        call=function("pendula.studies.pendula.chaotic_state.measure_over_the_top"),
        problem=lambda wildcards: run_of(
            **values_of(OVER_THE_TOP, "case", "tolerance"),
            **values_of(of_size(OVER_THE_TOP, wildcards), "end_time"),
        ),
        given=sized(OVER_THE_TOP, "members"),


use rule figure as draw_over_the_top with:
    "First passages of the pendula over the top"
    input:
        over_the_top="<results>/{size}pendula/over_the_top.nc",
    pathvars:
        made="<size>figures/pendula_over_the_top",
    params:
        call=function("pendula.studies.pendula.figures.draw_over_the_top"),


rule pendula:
    "Newton's equations beside the amplitude equations: datasets and figure"
    input:
        datasets=datasets("pendula", "threshold", "remainder", "sea", "over_the_top"),
        figure="<results>/figures/pendula_over_the_top.png",
