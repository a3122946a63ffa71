# The pendula themselves, Newton's equations (1), beside the amplitude equations (4).
THRESHOLD, REMAINDER, PHASES, SEA, OVER_THE_TOP, FILM = (
    getattr(SETTINGS.pendula, name)
    for name in ("threshold", "remainder", "phases", "sea", "over_the_top", "film")
)


use rule dataset as find_threshold with:
    "Lemma 1 for the pendula: the drive at which they lose stability, and rates of growth"
    pathvars:
        made="pendula/threshold",
    params:
        **values_of(THRESHOLD, "epsilon", "omegas", "mus", "half_width"),
        call=function("pendula.studies.pendula.threshold.threshold_contents"),
        growth_omegas=THRESHOLD.growth.omegas,
        gammas=THRESHOLD.growth.gammas.values,
        curve_omegas=THRESHOLD.curve.values,


use rule figure as pendula_threshold with:
    "The chart of Lemma 1 for the pendula, its correction, and rates of growth"
    input:
        threshold="<results>/pendula/threshold.nc",
    pathvars:
        made="figures/pendula_threshold",
    params:
        call=function("pendula.studies.pendula.figures.draw_threshold"),


use rule dataset as measure_remainder with:
    "How far the expansion (3) and its next order are from the pendula, and for how long they hold"
    pathvars:
        made="<size>pendula/remainder",
    params:
        **values_of(REMAINDER, "end_step", "spacing"),
        call=function("pendula.studies.pendula.remainder.remainder_contents"),
        problems=followed(
            REMAINDER.ends,
            REMAINDER.tolerance,
            end_time=REMAINDER.end_step,
            output_step=REMAINDER.end_step,
        ),
        run_ends=lambda wildcards: (REMAINDER.long_ends if wildcards.size else REMAINDER.run_ends),


use rule figure as draw_remainder with:
    "Errors of the expansion against time and against mu, and its horizons"
    input:
        remainder="<results>/{size}pendula/remainder.nc",
    pathvars:
        made="<size>figures/pendula_remainder",
    params:
        call=function("pendula.studies.pendula.figures.draw_remainder"),


use rule dataset as measure_phases with:
    "The cases of the paper as pendula at several mu: norms and space-time"
    input:
        kernels=kernels("taylor"),
    pathvars:
        made="pendula/phases",
    params:
        **values_of(PHASES, "mus", "look_every"),
        **values_of(PHASES.ensemble),
        call=function("pendula.studies.pendula.phases.measure_phases"),
        problems=followed(
            PAPER_CASES,
            PHASES.tolerance,
            output_step=PHASES.output_step,
            end_time=longest(PAPER_CASES),
        ),


use rule dataset as measure_sea with:
    "The state that fills the chain, of pendula beside that of the amplitudes"
    input:
        kernels=kernels("taylor"),
    pathvars:
        made="<size>pendula/sea",
    params:
        **values_of(SEA, "window", "size", "seed"),
        call=function("pendula.studies.pendula.chaotic_state.measure_sea"),
        problem=run_of(**values_of(SEA, "case", "tolerance", "output_step"), end_time=SEA.window[1]),
        given=sized(SEA, "mus", "members"),


use rule dataset as measure_over_the_top with:
    "When pendula go over the top, with what chance, and how far they turn then"
    input:
        kernels=kernels("taylor"),
    pathvars:
        made="<size>pendula/over_the_top",
    params:
        **values_of(OVER_THE_TOP, "mus", "per_period", "size", "seed", "settled"),
        call=function("pendula.studies.pendula.chaotic_state.measure_over_the_top"),
        problem=lambda wildcards: run_of(
            **values_of(OVER_THE_TOP, "case", "tolerance"),
            **values_of(of_size(OVER_THE_TOP, wildcards), "end_time"),
        ),
        given=sized(OVER_THE_TOP, "members"),


use rule dataset as film_pendula with:
    "The angles of the pendula for the moving pictures of the report"
    input:
        kernels=kernels("taylor"),
    pathvars:
        made="pendula/film",
    params:
        **values_of(FILM, "reach", "periods", "per_period"),
        call=function("pendula.studies.pendula.phases.film_pendula"),
        problems=followed(FILM.cases, FILM.tolerance, model="pendula", mu=FILM.mu),


use rule figure as pendula_phases with:
    "The paper's phases in the real pendula: norms and space-time"
    input:
        phases="<results>/pendula/phases.nc",
    pathvars:
        made="figures/pendula_phases",
    params:
        call=function("pendula.studies.pendula.figures_phases.draw_phases"),


use rule figure as draw_over_the_top with:
    "The chaotic state of the pendula, and first passages over the top"
    input:
        sea="<results>/{size}pendula/sea.nc",
        over_the_top="<results>/{size}pendula/over_the_top.nc",
        thermal="<results>/unbounded/thermal.nc",
    pathvars:
        made="<size>figures/pendula_over_the_top",
    params:
        call=function("pendula.studies.pendula.figures_phases.draw_over_the_top"),


rule pendula:
    "Newton's equations beside the amplitude equations: datasets and figures"
    input:
        datasets=datasets("pendula", "threshold", "remainder", "phases", "sea", "over_the_top"),
        film="<results>/pendula/film.nc",
        figures=expand(
            "<results>/figures/pendula_{name}.png",
            name=["threshold", "remainder", "phases", "over_the_top"],
        ),
