# The figures of Destyl, Nuiro, Pelinovsky and Poullet (2017), each from netCDF datasets.
# `snakemake` makes everything, `snakemake fig5` one figure, `snakemake --list` says what there is.


configfile: f"{workflow.basedir}/config/config.yaml"


include: "workflow/rules/common.smk"


rule all:
    "Everything"
    default_target: True
    input:
        expand("results/trajectories/{case}.nc", case=SETTINGS.cases),
        expand("results/trajectories/{case}.{solver}.nc", case=PAPER_CASES, solver=ALL_SOLVERS[1:]),
        expand("results/sweeps/{sweep}.nc", sweep=SETTINGS.sweeps),
        expand("results/sweeps/{sweep}.{solver}.nc", sweep=PAPER_SWEEPS, solver=["crank_nicolson"]),


include: "workflow/rules/trajectories.smk"
include: "workflow/rules/sweeps.smk"
