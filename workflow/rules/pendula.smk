# The pendula themselves, Newton's equations (1), beside the amplitude equations (4).


rule find_threshold:
    "Lemma 1 for the pendula: the drive at which they lose stability, and rates of growth"
    input:
        code=code("newton/find_threshold.py"),
    output:
        data="results/pendula/threshold.nc",
    log:
        "results/logs/pendula/threshold.log",
    conda:
        "../envs/pinned.yaml"
    params:
        **threshold_params(SETTINGS.pendula.threshold),
    message:
        "Finding the drive at which the pendula lose stability"
    script:
        "../../scripts/newton/find_threshold.py"


rule draw_threshold:
    "The chart of Lemma 1 for the pendula, its correction, and rates of growth"
    input:
        code=code("newton/draw_threshold.py"),
        threshold="results/pendula/threshold.nc",
    output:
        **figure("pendula_threshold"),
    log:
        "results/logs/figures/pendula_threshold.log",
    conda:
        "../envs/pinned.yaml"
    message:
        "Drawing the chart of Lemma 1 for the pendula"
    script:
        "../../scripts/newton/draw_threshold.py"


rule pendula:
    "Newton's equations beside the amplitude equations: datasets and figures"
    input:
        expand("results/pendula/{name}.nc", name=PENDULA),
        expand("results/figures/{name}.png", name=["pendula_threshold"]),
    message:
        "The study of the pendula is there"
