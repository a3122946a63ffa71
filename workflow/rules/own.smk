# Figures, checks and a report of a user's cases and sweeps, in results/own, where their names cannot collide with
# the paper's.


use rule dataset as own_checks with:
    "The checks of a case of your own: results/own/cases/{case}.checks.nc"
    input:
        lambda wildcards: kernels_for(SETTINGS.problem(wildcards.case), "taylor", "dop853"),
        run="<results>/trajectories/{case}.nc",
    pathvars:
        made="own/cases/<own_case>.checks",
    resources:
        **resources_for(
            lambda wildcards: SETTINGS.cost_estimate(wildcards.case)[1](
                SETTINGS.shown_problem(wildcards.case)
            )
        ),
    params:
        call=function("pendula.own_cases.checks.check_run"),
        problem=lambda wildcards: SETTINGS.shown_problem(wildcards.case),


use rule figure as own_norms with:
    "The norms of a case of your own: results/own/cases/{case}.png"
    input:
        run="<results>/trajectories/{case}.nc",
        checks="<results>/own/cases/{case}.checks.nc",
    pathvars:
        made="own/cases/<own_case>",
    params:
        call=function("pendula.own_cases.figures.draw_norms"),


use rule figure as own_spacetime with:
    "Where the chain of a case of your own moves: results/own/cases/{case}.spacetime.png"
    input:
        run="<results>/trajectories/{case}.nc",
    pathvars:
        made="own/cases/<own_case>.spacetime",
    params:
        call=function("pendula.own_cases.figures.draw_spacetime"),


use rule figure as own_breather with:
    "The localised state of a case of your own model: results/own/cases/{case}.breather.png"
    input:
        checks="<results>/own/cases/{case}.checks.nc",
    pathvars:
        made="own/cases/<own_case>.breather",
    params:
        call=function("latticode.drawing.runs.draw_breather"),


use rule figure as own_sweep_figure with:
    "The figure of a sweep of your own: results/own/sweeps/{sweep}.png"
    input:
        sweep="<results>/sweeps/{sweep}.nc",
    pathvars:
        made="own/sweeps/<own_sweep>",
    params:
        call=function("pendula.own_cases.figures.draw_sweep"),
        max_window=lambda wildcards: SETTINGS.drawn_windows(wildcards.sweep)["text_window"],
        mean_window=lambda wildcards: SETTINGS.drawn_windows(wildcards.sweep)["caption_window"],


use rule job as own_table with:
    "The norms of a case or sweep, or the numbers of a survey, as CSV: results/own/tables/{kind}/{name}.csv"
    input:
        data="<results>/{kind}/{name}.nc",
    output:
        table="<results>/own/tables/{kind,trajectories|sweeps|surveys}/{name}.csv",
    pathvars:
        made="own/tables/{kind}/{name}",
    params:
        call=function("pendula.own_cases.page.write_table"),


use rule job as own with:
    "A report of the cases and sweeps in your --configfile: results/own_report.html"
    input:
        files=lambda wildcards: stopping(own_files)(SETTINGS),
    output:
        html="<results>/own_report.html",
    pathvars:
        made="own/report",
    params:
        call=function("pendula.own_cases.page.write_report"),
        cases=OWN_CASES,
        sweeps={sweep: SETTINGS.sweeps[sweep].case for sweep in OWN_SWEEPS},
        surveys={survey: SETTINGS.surveys[survey].case for survey in OWN_SURVEYS},
        spectra={spectrum: SETTINGS.spectra[spectrum].case for spectrum in OWN_SPECTRA},
        sections={section: SETTINGS.sections[section].case for section in OWN_SECTIONS},


use rule dataset as survey with:
    "A survey of your own: results/surveys/{survey}.nc"
    input:
        lambda wildcards: kernels_for(SETTINGS.surveyed_problem(wildcards.survey)),
        chunks=chunks_of("surveys/{survey}", process_of_survey("{survey}")),
    pathvars:
        made="surveys/<own_survey><chunk>",
    resources:
        **resources_for(
            lambda wildcards: SETTINGS.cost_of_survey(wildcards.survey, chunks_in(wildcards.chunk))
        ),
    params:
        call=function("latticode.datasets.surveys.make_survey"),
        name="{survey}",
        problem=lambda wildcards: SETTINGS.surveyed_problem(wildcards.survey),
        survey=lambda wildcards: SETTINGS.plain_survey(wildcards.survey),


use rule figure as own_survey with:
    "The figure of a survey of your own: results/own/surveys/{survey}.png"
    input:
        survey="<results>/surveys/{survey}.nc",
    pathvars:
        made="own/surveys/<own_survey>",
    params:
        call=function("latticode.drawing.surveys.draw_survey"),


use rule dataset as spectrum with:
    "Lyapunov exponents of a case: results/spectra/{spectrum}.nc"
    pathvars:
        made="spectra/<own_spectrum>",
    resources:
        **resources_for(lambda wildcards: SETTINGS.cost_of_motion("spectra", wildcards.spectrum)),
    params:
        call=function("latticode.datasets.motions.measure_exponents"),
        name="{spectrum}",
        problem=lambda wildcards: SETTINGS.problem(SETTINGS.spectra[wildcards.spectrum].case),
        exponent_count=lambda wildcards: SETTINGS.spectra[wildcards.spectrum].count,


use rule dataset as section with:
    "Where a function of the fields crosses zero: results/sections/{section}.nc"
    pathvars:
        made="sections/<own_section>",
    resources:
        **resources_for(lambda wildcards: SETTINGS.cost_of_motion("sections", wildcards.section)),
    params:
        call=function("latticode.datasets.motions.find_section"),
        name="{section}",
        problem=lambda wildcards: SETTINGS.problem(SETTINGS.sections[wildcards.section].case),
        when=lambda wildcards: SETTINGS.plain_when(wildcards.section),
        direction=lambda wildcards: SETTINGS.sections[wildcards.section].direction,
        site=lambda wildcards: SETTINGS.sections[wildcards.section].site,
