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


rule measure_remainder:
    "How far the expansion (3) and its next order are from the pendula, and for how long they hold"
    input:
        code=code("newton/measure_remainder.py"),
    output:
        data="results/pendula/remainder.nc",
    log:
        "results/logs/pendula/remainder.log",
    conda:
        "../envs/pinned.yaml"
    params:
        **remainder_params(SETTINGS.pendula.remainder, SETTINGS.pendula.remainder.run_ends),
    message:
        "Measuring how far the expansion is from the pendula"
    script:
        "../../scripts/newton/measure_remainder.py"


use rule measure_remainder as measure_long_remainder with:
    "The same with all runs as long as those of the paper"
    output:
        data="results/pendula/long/remainder.nc",
    log:
        "results/logs/pendula/long_remainder.log",
    params:
        **remainder_params(SETTINGS.pendula.remainder, SETTINGS.pendula.remainder.long_ends),


rule draw_remainder:
    "Errors of the expansion against time and against mu, and its horizons"
    input:
        code=code("newton/draw_remainder.py"),
        remainder="results/pendula/remainder.nc",
    output:
        **figure("pendula_remainder"),
    log:
        "results/logs/figures/pendula_remainder.log",
    conda:
        "../envs/pinned.yaml"
    message:
        "Drawing how far the expansion is from the pendula"
    script:
        "../../scripts/newton/draw_remainder.py"


use rule draw_remainder as draw_long_remainder with:
    "The same of the longer study"
    input:
        code=code("newton/draw_remainder.py"),
        remainder="results/pendula/long/remainder.nc",
    output:
        **long_remainder_figure(),
    log:
        "results/logs/figures/long_remainder.log",


rule pendula:
    "Newton's equations beside the amplitude equations: datasets and figures"
    input:
        expand("results/pendula/{name}.nc", name=PENDULA),
        expand("results/figures/{name}.png", name=["pendula_threshold", "pendula_remainder"]),
    message:
        "The study of the pendula is there"


rule remainder:
    "The error of the expansion to the end of the paper's runs, which takes minutes: results/pendula/long/"
    input:
        rules.draw_long_remainder.output,
    message:
        "The long study of the expansion's error is there"
