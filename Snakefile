# The figures of Destyl, Nuiro, Pelinovsky and Poullet (2017), each from netCDF datasets.
# `snakemake` makes everything, `snakemake fig5` one figure, and `snakemake --list-target-rules` lists all
# targets.
from snakemake.utils import min_version

min_version("9.20")


report: "workflow/report/workflow.rst"


include: "workflow/rules/common.smk"
include: "workflow/rules/base.smk"


# Figures without a rule of this name: one job draws several of them, or its rule also serves a longer study
MADE_TOGETHER = {
    "fig2": "Fig 2: norms against time, in the paper at Omega = 8, for small and large amplitudes",
    "fig2_spacetime": "Where the chain moves in the cases of fig2",
    "fig3": "Fig 3: norms against time, in the paper at Omega = -4, for small and large amplitudes",
    "fig3_spacetime": "Where the chain moves in the cases of fig3",
    "fig4": "Fig 4: norms against time, in the paper at Omega = 0, for small and large amplitudes",
    "fig4_spacetime": "Where the chain moves in the cases of fig4",
    "fig5": "Fig 5: norms against half-width for small amplitudes",
    "fig6": "Fig 6: norms against half-width for large amplitudes",
    "pendula_over_the_top": "First passages of the pendula over the top",
    "growth_law": "The infinite chain: norms against time, and the law that they follow",
    "fronts": "The infinite chain: its two fronts, and the states behind them",
}
FIGURES = [
    *MADE_TOGETHER,
    "fig1",
    "energy_drift",
    "trust_horizons",
    "stability_chart",
    "bounds",
    "lifetimes",
    "fates",
]


include: "workflow/rules/paper.smk"
include: "workflow/rules/theory.smk"
include: "workflow/rules/chaos.smk"
include: "workflow/rules/breathers.smk"
include: "workflow/rules/newton.smk"
include: "workflow/rules/unbounded.smk"
include: "workflow/rules/exact.smk"
include: "workflow/rules/own.smk"


DATASETS = [
    *TRAJECTORIES,
    *SWEEPS,
    *SECOND_SWEEPS,
    *checks("identities", "cases", *THEORY_CHECKS, *CHAOS_CHECKS, *SOLVER_CHECKS, "hard_cases"),
    *rules.breathers.input.datasets,
    *rules.newton.input.datasets,
    *datasets("unbounded", *SETTINGS.unbounded.names, "thermal", "fronts"),
    *datasets("certified", "breathers"),
]


# Results of long studies that the article quotes, and their copies next to the article
QUOTED = [
    *expand("tests/baseline/quoted/{name}.nc", name=["unbounded", "chaos", "breathers", "pendula"]),
    "tests/baseline/quoted/reproduction.json",
    "tests/baseline/speed/work_precision.nc",
    *expand("tests/baseline/proofs/{case}.nc", case=PAPER_CASES),
]
QUOTED_COPIES = [f"<results>/{copy_of(path)}" for path in QUOTED]


rule all:
    "Everything: datasets, figures, tables and the report (the target of `snakemake` alone)"
    default_target: True
    input:
        DATASETS,
        datasets("trajectories", *OWN_CASES),
        datasets("sweeps", *OWN_SWEEPS),
        figure_files(*(f"<results>/figures/{name}" for name in FIGURES)),
        "<results>/claims.json",
        expand("<results>/tables/{name}.md", name=["claims", "claims_figures"]),
        "<results>/report.html",
        "<results>/live.html",
        expand("<results>/article.{kind}", kind=["pdf", "html", "yaml"]),
        QUOTED_COPIES,
    message:
        "Ready: all datasets, figures and tables; begin with results/article.html and results/report.html"


rule paper:
    "Figs 1 to 6 of the paper, and a table of the claims on them: results/tables/claims_figures.md"
    input:
        figure_files(*(f"<results>/figures/{name}" for name in PAPER_FIGURES)),
        "<results>/tables/claims_figures.md",


rule figures:
    "All figures, each as PNG and PDF with the data that it shows"
    input:
        figure_files(*(f"<results>/figures/{name}" for name in FIGURES)),


rule theory:
    "The checks of the paper's theory, the ledger of its claims, and their figures"
    input:
        checks("identities", "cases", *THEORY_CHECKS),
        expand("<results>/figures/{name}.png", name=["stability_chart", "bounds"]),
        "<results>/claims.json",


rule chaos:
    "How fast small errors grow, ensembles of every case, and how long the centre stays excited"
    input:
        checks(*CHAOS_CHECKS),
        rules.lifetimes.output,


include: "workflow/rules/ledger.smk"
include: "workflow/rules/documents.smk"
include: "workflow/rules/baseline.smk"
include: "workflow/rules/figure_diff.smk"
include: "workflow/rules/speed.smk"


# Targets in README.md that have no rule of their own: some figures, longer studies, cases and sweeps
NAMED = {
    name: (text, figure_files(f"<results>/figures/{name}")) for name, text in MADE_TOGETHER.items()
}
LONGER_STUDIES = {
    "fates": "The map of fates on a fine grid, which takes minutes",
    "over_the_top": "First passages of the pendula over the top, with many members and long runs",
}
OTHER_CHOICES = {  # datasets in which the printed numbers are measured again with other choices
    "fates": datasets("long/breathers", "areas", "least_power"),
    "over_the_top": datasets("long/pendula", "varied"),
}
for name, text in LONGER_STUDIES.items():
    figure = name if name in FIGURES else f"pendula_{name}"
    files = [*figure_files(f"<results>/long/figures/{figure}"), *OTHER_CHOICES[name]]
    NAMED[name] = f"{text}: results/long/figures/", files
NAMED["sensitivity"] = (
    "Share of a perturbed ensemble that spreads, with many members: results/long/breathers/",
    datasets("long/breathers", "sensitivity", "shares"),
)
NAMED["transition"] = (
    "Transition and life of the centre at Omega = 0, with many members: results/long/chaos/",
    datasets("long/chaos", "lifetimes"),
)
OF_MANY_RUNS = {  # datasets whose rules have a wildcard for chunks, so that no rule can be a target
    "measure_ensembles": (
        "Chaotic sweeps from slightly perturbed initial data",
        "checks/ensembles",
    ),
    "measure_second_solver": (
        "A chaotic sweep by the paper's second solver, and by that of the ensembles",
        "checks/second_solver",
    ),
    "measure_members": ("Ensembles of every case", "checks/members"),
    "measure_lifetimes": (
        "When the chain turns chaotic, and how long its centre stays excited",
        "checks/lifetimes",
    ),
    "solve_transverse": (
        "The growth of a small A + B where A = -B, and the second front that follows",
        "long/unbounded/transverse",
    ),
    "follow_noise": ("The second front if noise makes A + B grow", "long/unbounded/noise"),
}
for name, (text, dataset) in OF_MANY_RUNS.items():
    NAMED[name] = f"{text}: results/{dataset}.nc", [f"<results>/{dataset}.nc"]
for case in PAPER_CASES:
    runs = [f"{case}.{solver}" for solver in ALL_SOLVERS]
    NAMED[case] = f"The case {case} by every solver", datasets("trajectories", case, *runs)
for sweep in PAPER_SWEEPS:
    files = expand(
        "<results>/sweeps/{sweep}{solver}.nc", sweep=sweep, solver=["", ".crank_nicolson"]
    )
    NAMED[sweep] = f"The sweep {sweep} by both solvers of the paper", files
for name, (text, files) in NAMED.items():

    rule:
        name:
            name
        input:
            files,

    *_, made = workflow.rules
    made.docstring = text


# A target may have hundreds of input files: print one line, with the file to begin with, once all of
# them are ready. In the list of targets a star marks the most used ones.
MOST_USED = """
    all paper figures theory own report article live figure_diff accept_figures archive unbounded speed
""".split()
for target in workflow.rules:
    if not target.output and not target.message:
        place = "" if "results/" in target.docstring else "; begin with {input[0]}"
        target.message = f"Ready: {target.docstring}{place}"
    if target.name in MOST_USED:
        target.docstring = f"* {target.docstring}"


onstart:
    REFUSALS.refuse_read_only_results()
    if workflow.executor_plugin.name == "slurm":
        REFUSALS.refuse_endless_requests()


# Hooks print below Snakemake's last lines
onsuccess:
    if "figure_diff" in {job.rule.name for job in workflow.dag.jobs}:
        report_comparison()


onerror:
    atexit.register(print, failures_in_words(), file=sys.stderr)
