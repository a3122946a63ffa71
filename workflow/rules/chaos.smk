# Chaos in the chain: how fast small errors grow, and what ensembles of runs have in common.
LYAPUNOV, ENSEMBLES, SECOND, MEMBERS = (
    getattr(SETTINGS.chaos, name) for name in ("lyapunov", "ensembles", "second_solver", "members")
)
LIFETIMES = SETTINGS.chaos.lifetimes
STARTS, CLOCKS = ("amplitudes", "ratio"), ("size", "seed", "window", "level", "multiple")
SPECTRUM = LYAPUNOV.spectrum


use rule dataset as measure_lyapunov with:
    "The largest Lyapunov exponent of every case, and all exponents on short chains"
    input:
        kernels("dop853"),
    pathvars:
        made="checks/lyapunov",
    params:
        **values_of(LYAPUNOV, "span", "members", "size", "seed"),
        call=function("pendula.studies.chaos.lyapunov.measure_lyapunov"),
        problems=SETTINGS.runs_of_cases(PAPER_CASES, LYAPUNOV.tolerance, "dop853"),
        short_problems=SETTINGS.runs_of_cases(
            SPECTRUM.cases,
            SPECTRUM.tolerance,
            "dop853",
            half_width=SPECTRUM.half_width,
            end_time=SPECTRUM.duration_factor * SETTINGS.latest_end(SPECTRUM.cases),
        ),
        undriven_end=SPECTRUM.undriven_duration_factor * SETTINGS.latest_end(SPECTRUM.cases),


use rule dataset as run_ensembles with:
    "Chaotic sweeps from slightly perturbed initial data"
    input:
        kernels("taylor"),
        chunks=chunks_of("checks/ensembles"),
    pathvars:
        made="checks/ensembles<chunk>",
    params:
        **values_of(ENSEMBLES, "size", "seed"),
        call=function("pendula.studies.chaos.ensembles.measure_ensembles"),
        swept={
            sweep: {**SETTINGS.chaos.member_of(SETTINGS, sweep), **dict(ensemble)}
            for sweep, ensemble in ENSEMBLES.sweeps.items()
        },


use rule dataset as run_second_solver with:
    "A chaotic sweep by the paper's second solver with two steps, and by the solver of the ensembles"
    input:
        kernels("taylor", "crank_nicolson"),
        chunks=chunks_of("checks/second_solver"),
    pathvars:
        made="checks/second_solver<chunk>",
    params:
        **values_of(SECOND, "half_widths", "members", "first_members", "seed"),
        call=function("pendula.studies.chaos.ensembles.measure_second_solver"),
        first=SETTINGS.chaos.member_of(SETTINGS, SECOND.sweep)["problem"],
        second=SETTINGS.chaos.by_second_solver(SETTINGS, SECOND.sweep),
        windows=SETTINGS.chaos.member_of(SETTINGS, SECOND.sweep)["windows"],
        size=ENSEMBLES.size,


use rule dataset as run_members with:
    "Ensembles of every case: bands of norms, and the numbers for the paper's claims"
    input:
        kernels("taylor"),
        chunks=chunks_of("checks/members"),
    pathvars:
        made="checks/members<chunk>",
    params:
        **values_of(MEMBERS, "windows", "members", "size", "seed"),
        call=function("pendula.studies.chaos.members.measure_members"),
        problems=SETTINGS.runs_of_cases(
            PAPER_CASES,
            MEMBERS.tolerance,
            end_time=max(end for _, end in MEMBERS.windows),
            output_step=MEMBERS.output_step,
            snapshot_every=1,
        ),


use rule dataset as run_lifetimes with:
    "Ensembles that show when the chain turns chaotic and how long its centre stays excited"
    input:
        kernels("taylor"),
        chunks=chunks_of("checks/lifetimes"),
    pathvars:
        made="checks/lifetimes<chunk>",
    params:
        **values_of(LIFETIMES, *STARTS, *CLOCKS, "members"),
        call=function("pendula.studies.chaos.lifetimes.measure_lifetimes"),
        problem=run_of(**values_of(LIFETIMES, "case", "tolerance", "end_time", "output_step")),


use rule dataset as vary_lifetimes with:
    "The same times with many members, measured again with each choice changed"
    input:
        kernels("taylor"),
    pathvars:
        made="long/chaos/lifetimes",
    resources:
        **resources_for(long_study),
    params:
        **values_of(LIFETIMES, *STARTS),
        **values_of(LIFETIMES.long),
        call=function("pendula.studies.chaos.lifetimes.vary_lifetimes"),
        problem=run_of(**values_of(LIFETIMES, "case", "tolerance", "end_time", "output_step")),
        chosen=values_of(LIFETIMES, *CLOCKS, "tolerance", "output_step"),


use rule figure as lifetimes with:
    "When the chain turns chaotic, and how long its centre stays excited"
    input:
        lifetimes="<results>/checks/lifetimes.nc",
    pathvars:
        made="figures/lifetimes",
    params:
        call=function("pendula.studies.chaos.figures.draw_lifetimes"),
