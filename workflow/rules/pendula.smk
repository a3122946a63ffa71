# The pendula themselves, Newton's equations (1), beside the amplitude equations (4).

PENDULA_FIGURES = [
    *("pendula_threshold", "pendula_remainder", "pendula_phases", "pendula_over_the_top"),
]


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


rule pendula_threshold:
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
    params:
        differs=differs_of,
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


rule pendula_remainder:
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
    params:
        differs=differs_of,
    message:
        "Drawing how far the expansion is from the pendula"
    script:
        "../../scripts/newton/draw_remainder.py"


use rule pendula_remainder as draw_long_remainder with:
    "The same of runs as long as those of the paper"
    input:
        code=code("newton/draw_remainder.py"),
        remainder="results/pendula/long/remainder.nc",
    output:
        **long_remainder_figure(),
    log:
        "results/logs/figures/long_remainder.log",


rule measure_phases:
    "The cases of the paper as pendula at several mu: norms and space-time"
    input:
        code=code("newton/measure_phases.py"),
        kernels=kernels("taylor"),
    output:
        data="results/pendula/phases.nc",
    log:
        "results/logs/pendula/phases.log",
    conda:
        "../envs/pinned.yaml"
    params:
        **phases_params(SETTINGS.pendula.phases),
    message:
        "Following the cases of the paper as pendula"
    script:
        "../../scripts/newton/measure_phases.py"


rule measure_sea:
    "The state that fills the chain, of pendula beside that of the amplitudes"
    input:
        code=code("newton/measure_sea.py"),
        kernels=kernels("taylor"),
    output:
        data="results/pendula/sea.nc",
    log:
        "results/logs/pendula/sea.log",
    conda:
        "../envs/pinned.yaml"
    params:
        **sea_params(SETTINGS.pendula.sea, SETTINGS.pendula.sea),
    message:
        "Measuring the sea of the pendula"
    script:
        "../../scripts/newton/measure_sea.py"


use rule measure_sea as measure_long_sea with:
    "The same with more members, and at a smaller mu"
    output:
        data="results/pendula/long/sea.nc",
    log:
        "results/logs/pendula/long_sea.log",
    params:
        **sea_params(SETTINGS.pendula.sea, SETTINGS.pendula.sea.long),


rule measure_over_the_top:
    "When pendula go over the top, with what chance, and how far they turn then"
    input:
        code=code("newton/measure_over_the_top.py"),
        kernels=kernels("taylor"),
    output:
        data="results/pendula/over_the_top.nc",
    log:
        "results/logs/pendula/over_the_top.log",
    conda:
        "../envs/pinned.yaml"
    params:
        **passage_params(SETTINGS.pendula.over_the_top, SETTINGS.pendula.over_the_top),
    message:
        "Waiting for pendula to go over the top"
    script:
        "../../scripts/newton/measure_over_the_top.py"


use rule measure_over_the_top as measure_long_over_the_top with:
    "The same with more members, for longer"
    output:
        data="results/pendula/long/over_the_top.nc",
    log:
        "results/logs/pendula/long_over_the_top.log",
    params:
        **passage_params(SETTINGS.pendula.over_the_top, SETTINGS.pendula.over_the_top.long),


rule film_pendula:
    "The angles of the pendula for the moving pictures of the report"
    input:
        code=code("newton/film_pendula.py"),
        kernels=kernels("taylor"),
    output:
        data="results/pendula/film.nc",
    log:
        "results/logs/pendula/film.log",
    conda:
        "../envs/pinned.yaml"
    params:
        **film_params(SETTINGS.pendula.film),
    message:
        "Filming the pendula"
    script:
        "../../scripts/newton/film_pendula.py"


rule pendula_phases:
    "The paper's phases in the real pendula: norms and space-time"
    input:
        code=code("newton/draw_phases.py"),
        phases="results/pendula/phases.nc",
    output:
        **figure("pendula_phases"),
    log:
        "results/logs/figures/pendula_phases.log",
    conda:
        "../envs/pinned.yaml"
    params:
        differs=differs_of,
    message:
        "Drawing the phases of the pendula"
    script:
        "../../scripts/newton/draw_phases.py"


rule pendula_over_the_top:
    "The sea of the pendula, and who leaves it over the top"
    input:
        code=code("newton/draw_over_the_top.py"),
        sea="results/pendula/sea.nc",
        over_the_top="results/pendula/over_the_top.nc",
        thermal="results/unbounded/thermal.nc",
    output:
        **figure("pendula_over_the_top"),
    log:
        "results/logs/figures/pendula_over_the_top.log",
    conda:
        "../envs/pinned.yaml"
    params:
        differs=differs_of,
    message:
        "Drawing the sea of the pendula"
    script:
        "../../scripts/newton/draw_over_the_top.py"


use rule pendula_over_the_top as draw_long_over_the_top with:
    "The same of many members, followed for long"
    input:
        code=code("newton/draw_over_the_top.py"),
        sea="results/pendula/long/sea.nc",
        over_the_top="results/pendula/long/over_the_top.nc",
        thermal="results/unbounded/thermal.nc",
    output:
        **long_passages_figure(),
    log:
        "results/logs/figures/long_over_the_top.log",


rule pendula:
    "Newton's equations beside the amplitude equations: datasets and figures"
    input:
        expand("results/pendula/{name}.nc", name=[*PENDULA, "film"]),
        expand("results/figures/{name}.png", name=PENDULA_FIGURES),
    message:
        "The study of the pendula is there"


rule remainder:
    "The error of the expansion to the end of the paper's runs, which takes a minute: results/pendula/long/"
    input:
        rules.draw_long_remainder.output,
    message:
        "The long study of the expansion's error is there"


rule over_the_top:
    "The sea, and when pendula go over the top, with many members for long: results/pendula/long/"
    input:
        rules.draw_long_over_the_top.output,
    message:
        "The long study of pendula that go over the top is there"
