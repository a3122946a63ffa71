# Chaos in the chain: how fast small errors grow, and what that leaves to be trusted.


rule measure_lyapunov:
    "Lyapunov exponents of every case, and when runs leave the solution"
    input:
        code=code("chaos/measure_lyapunov.py"),
        kernels=kernels("dop853", "taylor"),
    output:
        data="results/checks/lyapunov.nc",
    log:
        "results/logs/checks/lyapunov.log",
    conda:
        "../envs/pinned.yaml"
    params:
        **lyapunov_params(SETTINGS.chaos.lyapunov),
    message:
        "Measuring Lyapunov exponents"
    script:
        "../../scripts/chaos/measure_lyapunov.py"


rule measure_symmetry:
    "How even data lose their evenness: by rounding, and by odd perturbations"
    input:
        code=code("chaos/measure_symmetry.py"),
        kernels=kernels("dop853"),
    output:
        data="results/checks/symmetry.nc",
    log:
        "results/logs/checks/symmetry.log",
    conda:
        "../envs/pinned.yaml"
    params:
        **symmetry_params(SETTINGS.chaos.symmetry),
    message:
        "Measuring how evenness is lost"
    script:
        "../../scripts/chaos/measure_symmetry.py"


rule measure_ensembles:
    "Chaotic cases and sweeps from data that differ in their last digits"
    input:
        code=code("chaos/measure_ensembles.py"),
        kernels=kernels("taylor"),
    output:
        data="results/checks/ensembles{kind}.nc",
    log:
        "results/logs/checks/ensembles{kind}.log",
    wildcard_constraints:
        kind="|_uneven",
    conda:
        "../envs/pinned.yaml"
    params:
        **ensemble_params(SETTINGS.chaos.ensembles),
        kind=lambda wildcards: wildcards.kind.removeprefix("_") or "even",
    message:
        "Running ensembles of the chaotic cases and sweeps"
    script:
        "../../scripts/chaos/measure_ensembles.py"


rule measure_members:
    "Ensembles of every case, reduced to the numbers that sentences of the paper are about"
    input:
        code=code("chaos/measure_members.py"),
        kernels=kernels("taylor"),
    output:
        data="results/checks/members.nc",
    log:
        "results/logs/checks/members.log",
    conda:
        "../envs/pinned.yaml"
    params:
        **member_params(SETTINGS.chaos.members),
    message:
        "Running ensembles of every case, even in n and not"
    script:
        "../../scripts/chaos/measure_members.py"


rule measure_lifetimes:
    "Ensembles that tell when the central pendulum stops being localised, by its initial amplitude"
    input:
        code=code("chaos/measure_lifetimes.py"),
        kernels=kernels("taylor"),
    output:
        data="results/checks/lifetimes.nc",
    log:
        "results/logs/checks/lifetimes.log",
    conda:
        "../envs/pinned.yaml"
    params:
        **lifetime_params(SETTINGS.chaos.lifetimes),
    message:
        "Measuring how long the central pendulum stays localised"
    script:
        "../../scripts/chaos/measure_lifetimes.py"


rule lifetimes:
    "How long the central pendulum stays localised, against its initial amplitude"
    input:
        code=code("chaos/draw_lifetimes.py"),
        lifetimes="results/checks/lifetimes.nc",
    output:
        **figure("lifetimes"),
    log:
        "results/logs/figures/lifetimes.log",
    conda:
        "../envs/pinned.yaml"
    params:
        differs=differs_of,
    message:
        "Drawing how long the central pendulum stays localised"
    script:
        "../../scripts/chaos/draw_lifetimes.py"


rule chaos_figures:
    "The two figures lyapunov and symmetry"
    input:
        code=code("chaos/draw_chaos.py"),
        lyapunov="results/checks/lyapunov.nc",
        symmetry="results/checks/symmetry.nc",
    output:
        exponents=files_of("results/figures/lyapunov"),
        odd_parts=files_of("results/figures/symmetry"),
    log:
        "results/logs/figures/chaos.log",
    conda:
        "../envs/pinned.yaml"
    params:
        differs=differs_of,
    message:
        "Drawing Lyapunov exponents, and how evenness is lost"
    script:
        "../../scripts/chaos/draw_chaos.py"


rule compare_ensembles:
    "The paper's own runs, and the references, beside the ensembles"
    input:
        code=code("chaos/compare_ensembles.py"),
        ensembles="results/checks/ensembles.nc",
        lyapunov="results/checks/lyapunov.nc",
        runs=expand("results/trajectories/{case}.nc", case=ENSEMBLE_CASES),
        references=references(*ENSEMBLE_CASES),
        sweeps=expand("results/sweeps/{sweep}.nc", sweep=ENSEMBLE_SWEEPS),
    output:
        data="results/checks/ensemble_runs.nc",
    log:
        "results/logs/checks/ensemble_runs.log",
    conda:
        "../envs/pinned.yaml"
    params:
        cases=ENSEMBLE_CASES,
        windows={sweep: drawn_windows(sweep)["text_window"] for sweep in ENSEMBLE_SWEEPS},
    message:
        "Comparing the paper's runs with ensembles"
    script:
        "../../scripts/chaos/compare_ensembles.py"


rule ensembles:
    "What runs from almost equal data share, beside the paper's own"
    input:
        code=code("chaos/draw_ensembles.py"),
        ensembles="results/checks/ensembles.nc",
        comparison="results/checks/ensemble_runs.nc",
    output:
        **figure("ensembles"),
    log:
        "results/logs/figures/ensembles.log",
    conda:
        "../envs/pinned.yaml"
    params:
        differs=differs_of,
    message:
        "Drawing ensembles of the chaotic cases and sweeps beside the paper's runs"
    script:
        "../../scripts/chaos/draw_ensembles.py"
