# Names that README.md gives and that are no rule of their own: figures that another figure brings
# along, cases, and sweeps. Each can be called as it stands there.
NAMED_FIGURES = {
    **{f"fig{n}_spacetime": f"Where the chain moves, made together with fig{n}" for n in (2, 3, 4)},
    "energy_drift": "How well each solver conserves the energy",
    "solver_agreement": "Until when the solvers draw the same curves",
    "stability_chart": "Lemma 1: where the chain at rest is unstable",
    "growth_rates": "Lemma 1: how fast small motions grow where the chain at rest is unstable",
    "lyapunov": "How fast small errors grow, and until when a run can be trusted",
    "symmetry": "How a motion that is even in n loses its evenness",
}
NAMED = {name: (text, [*figure(name).values()]) for name, text in NAMED_FIGURES.items()}
for case in PAPER_CASES:
    stem = f"results/trajectories/{case}"
    files = [f"{stem}.nc", *by_solvers(stem, ALL_SOLVERS)]
    NAMED[case] = f"The case {case} by every solver", files
for sweep in PAPER_SWEEPS:
    stem = f"results/sweeps/{sweep}"
    files = [f"{stem}.nc", *by_solvers(stem, ["crank_nicolson"])]
    NAMED[sweep] = f"The sweep {sweep} by both solvers of the paper", files

for name, (text, files) in NAMED.items():

    rule:
        name:
            name
        input:
            files,
        message:
            f"{text}: there"

    workflow.get_rule(name).docstring = text
