# Chaos in the chain: how fast small errors grow, and what that leaves to be trusted.
LYAPUNOV, ENSEMBLES, MEMBERS = (
    getattr(SETTINGS.chaos, name) for name in ("lyapunov", "ensembles", "members")
)
SYMMETRY, LIFETIMES = SETTINGS.chaos.symmetry, SETTINGS.chaos.lifetimes
SPECTRUM = LYAPUNOV.spectrum


use rule dataset as measure_lyapunov with:
    "Lyapunov exponents of every case, and when runs leave the solution"
    input:
        kernels=kernels("dop853", "taylor"),
    pathvars:
        made="checks/lyapunov",
    params:
        call=function("pendula.studies.chaos.lyapunov.measure_lyapunov"),
        problems=followed(PAPER_CASES, LYAPUNOV.tolerance, "dop853"),
        end_time=LYAPUNOV.lengths * longest(PAPER_CASES),
        tolerances=LYAPUNOV.diverging_tolerances,
        short_problems=followed(SPECTRUM.cases, SPECTRUM.tolerance, "dop853"),
        short_end_times={
            half_width: times * longest(SPECTRUM.cases)
            for half_width, times in SPECTRUM.lengths.items()
        },
        undriven_end=SPECTRUM.undriven_lengths * longest(SPECTRUM.cases),
        seed=LYAPUNOV.seed,


use rule dataset as measure_symmetry with:
    "How symmetric motions lose their symmetry: by rounding, and by odd perturbations"
    input:
        kernels=kernels("dop853"),
    pathvars:
        made="checks/symmetry",
    params:
        **values_of(SYMMETRY, "size", "members", "seed"),
        call=function("pendula.studies.chaos.symmetry.odd_parts"),
        problems=followed(PAPER_CASES, SYMMETRY.tolerance, "dop853", end_time=longest(PAPER_CASES)),
        step=SYMMETRY.output_step,


use rule dataset as measure_ensembles with:
    "Chaotic cases and sweeps from data that differ in their last digits"
    input:
        kernels=kernels("taylor"),
    pathvars:
        made="checks/ensembles{kind,|_uneven}",
    params:
        **values_of(ENSEMBLES, "members", "size", "seed"),
        call=function("pendula.studies.chaos.ensembles.measure_ensembles"),
        problems=lambda wildcards: followed(
            [] if wildcards.kind else ENSEMBLES.cases,
            ENSEMBLES.tolerance,
            end_time=longest(ENSEMBLES.cases),
            output_step=min(SETTINGS.cases[case].output_step for case in ENSEMBLES.cases),
        ),
        swept=lambda wildcards: swept(
            ENSEMBLES.uneven if wildcards.kind else ENSEMBLES.sweeps, ENSEMBLES.tolerance
        ),
        windows=in_any(ENSEMBLES.sweeps, "windows"),
        kind=lambda wildcards: wildcards.kind.removeprefix("_") or "even",


use rule dataset as measure_members with:
    "Ensembles of every case, reduced to the numbers that sentences of the paper are about"
    input:
        kernels=kernels("taylor"),
    pathvars:
        made="checks/members",
    params:
        **values_of(MEMBERS, "windows", "members", "size", "seed"),
        call=function("pendula.studies.chaos.members.member_numbers"),
        problems=followed(
            PAPER_CASES,
            MEMBERS.tolerance,
            end_time=max(end for _, end in MEMBERS.windows),
            snapshot_every=MEMBERS.every,
        ),


use rule dataset as measure_lifetimes with:
    "Ensembles that show when the central pendulum stops being localised, by its initial amplitude"
    input:
        kernels=kernels("taylor"),
    pathvars:
        made="checks/lifetimes",
    params:
        **values_of(LIFETIMES, "amplitudes", "ratio", "compared", "size", "members"),
        **values_of(LIFETIMES, "settled", "seed"),
        call=function("pendula.studies.chaos.lifetimes.measure_lifetimes"),
        problem=run_of(**values_of(LIFETIMES, "case", "tolerance", "end_time", "output_step")),


use rule figure as lifetimes with:
    "How long the central pendulum stays localised, against its initial amplitude"
    input:
        lifetimes="<results>/checks/lifetimes.nc",
    pathvars:
        made="figures/lifetimes",
    params:
        call=function("pendula.studies.chaos.figures.draw_lifetimes"),


use rule figure as chaos_figures with:
    "The two figures lyapunov and symmetry"
    input:
        lyapunov="<results>/checks/lyapunov.nc",
        symmetry="<results>/checks/symmetry.nc",
    output:
        figure_files("<results>/figures/lyapunov"),
        figure_files("<results>/figures/symmetry"),
    pathvars:
        made="figures/chaos",
    params:
        call=function(
            "pendula.studies.chaos.figures.draw_lyapunov",
            "pendula.studies.chaos.figures.draw_symmetry",
        ),


use rule dataset as compare_ensembles with:
    "The paper's own runs, and the references, beside the ensembles"
    input:
        ensembles="<results>/checks/ensembles.nc",
        lyapunov="<results>/checks/lyapunov.nc",
        runs=datasets("trajectories", *ENSEMBLES.cases),
        sweeps=datasets("sweeps", *ENSEMBLES.sweeps),
    pathvars:
        made="checks/ensemble_runs",
    params:
        call=function("pendula.studies.chaos.ensembles.compare_runs"),
        committed=committed(references=references(*ENSEMBLES.cases)),
        windows={sweep: drawn_windows(sweep)["text_window"] for sweep in ENSEMBLES.sweeps},


use rule figure as ensembles with:
    "Statistics of perturbed ensembles, beside the paper's own runs"
    input:
        ensembles="<results>/checks/ensembles.nc",
        comparison="<results>/checks/ensemble_runs.nc",
    pathvars:
        made="figures/ensembles",
    params:
        call=function("pendula.studies.chaos.figures.draw_ensembles"),
