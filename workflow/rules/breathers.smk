# Breathers: states that stay at one pair, what becomes of data there, and which of them spread.


rule steady_breathers:
    "Steady states localised at one pair: families, where they are born, where they are stable"
    input:
        code=code("breathers/find_steady.py"),
    output:
        data="results/breathers/steady.nc",
    log:
        "results/logs/breathers/steady.log",
    conda:
        "../envs/pinned.yaml"
    params:
        **steady_params(SETTINGS.breathers),
    message:
        "Finding steady breathers"
    script:
        "../../scripts/breathers/find_steady.py"


rule periodic_breathers:
    "Periodic motions localised at one pair, and how fast their perturbations grow"
    input:
        code=code("breathers/find_periodic.py"),
        kernels=kernels("taylor"),
    output:
        data="results/breathers/periodic.nc",
    log:
        "results/logs/breathers/periodic.log",
    conda:
        "../envs/pinned.yaml"
    params:
        **periodic_params(SETTINGS.breathers),
    message:
        "Finding periodic breathers"
    script:
        "../../scripts/breathers/find_periodic.py"


rule perturbed_breathers:
    "How stable breathers move after a change, for thousands of periods: results/breathers/long/"
    input:
        code=code("breathers/perturb_breathers.py"),
        kernels=kernels("taylor"),
    output:
        data="results/breathers/long/perturbed.nc",
    log:
        "results/logs/breathers/long_perturbed.log",
    conda:
        "../envs/pinned.yaml"
    params:
        **perturbed_params(SETTINGS.breathers),
    message:
        "Following changed breathers for thousands of periods"
    script:
        "../../scripts/breathers/perturb_breathers.py"


rule growth_by_drive:
    "How the drive feeds a localised motion, beside the law of weak drives"
    input:
        code=code("breathers/measure_growth_by_drive.py"),
        kernels=kernels("taylor"),
    output:
        data="results/breathers/growth.nc",
    log:
        "results/logs/breathers/growth.log",
    conda:
        "../envs/pinned.yaml"
    params:
        **drive_params(SETTINGS.breathers),
    message:
        "Measuring how a localised motion grows by the drive"
    script:
        "../../scripts/breathers/measure_growth_by_drive.py"


rule measure_sensitivity:
    "Which of almost equal data spread over the chain"
    input:
        code=code("breathers/measure_sensitivity.py"),
        kernels=kernels("taylor"),
    output:
        data="results/breathers/sensitivity.nc",
    log:
        "results/logs/breathers/sensitivity.log",
    conda:
        "../envs/pinned.yaml"
    params:
        **sensitivity_params(SETTINGS.breathers.sensitivity, "full"),
    message:
        "Measuring which of almost equal data spread"
    script:
        "../../scripts/breathers/measure_sensitivity.py"


use rule measure_sensitivity as measure_long_sensitivity with:
    "The same with more members and a longer scan"
    output:
        data="results/breathers/long/sensitivity.nc",
    log:
        "results/logs/breathers/long_sensitivity.log",
    params:
        **sensitivity_params(SETTINGS.breathers.sensitivity, "long"),


rule map_fates:
    "What becomes of data on one pair: they disperse, stay, move or spread"
    input:
        code=code("breathers/map_fates.py"),
        kernels=kernels("taylor"),
        periodic="results/breathers/periodic.nc",
        fine=fine_maps_of_fates(),
    output:
        data="results/breathers/fates.nc",
    log:
        "results/logs/breathers/fates.log",
    conda:
        "../envs/pinned.yaml"
    params:
        **fate_params(SETTINGS.breathers, "full"),
    message:
        "Mapping what becomes of data on one pair"
    script:
        "../../scripts/breathers/map_fates.py"


use rule map_fates as map_long_fates with:
    "The same on a fine grid"
    input:
        code=code("breathers/map_fates.py"),
        kernels=kernels("taylor"),
        periodic="results/breathers/periodic.nc",
    output:
        data="results/breathers/long/fates.nc",
    log:
        "results/logs/breathers/long_fates.log",
    params:
        **fate_params(SETTINGS.breathers, "long"),


rule draw_breathers:
    "Periodic breathers against their frequency, and how the drive feeds a localised motion"
    input:
        code=code("breathers/draw_breathers.py"),
        periodic="results/breathers/periodic.nc",
        growth="results/breathers/growth.nc",
    output:
        **figure("breathers"),
    log:
        "results/logs/figures/breathers.log",
    conda:
        "../envs/pinned.yaml"
    params:
        differs=differs_of,
    message:
        "Drawing breathers and their growth by the drive"
    script:
        "../../scripts/breathers/draw_breathers.py"


rule draw_sensitivity:
    "Which of almost equal data spread over the chain, as a picture"
    input:
        code=code("breathers/draw_sensitivity.py"),
        sensitivity="results/breathers/sensitivity.nc",
    output:
        **figure("sensitivity"),
    log:
        "results/logs/figures/sensitivity.log",
    conda:
        "../envs/pinned.yaml"
    params:
        differs=differs_of,
    message:
        "Drawing which of almost equal data spread"
    script:
        "../../scripts/breathers/draw_sensitivity.py"


use rule draw_sensitivity as draw_long_sensitivity with:
    "The same with more members and a longer scan, drawn"
    input:
        code=code("breathers/draw_sensitivity.py"),
        sensitivity="results/breathers/long/sensitivity.nc",
    output:
        **long_breathers_figure("sensitivity"),
    log:
        "results/logs/figures/long_sensitivity.log",


rule draw_fates:
    "What becomes of data on one pair, as a map"
    input:
        code=code("breathers/draw_fates.py"),
        fates="results/breathers/fates.nc",
        fine=fine_maps_of_fates(),
    output:
        **figure("fates"),
    log:
        "results/logs/figures/fates.log",
    conda:
        "../envs/pinned.yaml"
    params:
        differs=differs_of,
    message:
        "Drawing what becomes of data on one pair"
    script:
        "../../scripts/breathers/draw_fates.py"


use rule draw_fates as draw_long_fates with:
    "The same map on a fine grid"
    input:
        code=code("breathers/draw_fates.py"),
        fates="results/breathers/long/fates.nc",
    output:
        **long_breathers_figure("fates"),
    log:
        "results/logs/figures/long_fates.log",


rule breathers:
    "States that stay at one pair, which data reach them, and which spread: datasets and figures"
    input:
        expand("results/breathers/{name}.nc", name=BREATHERS),
        expand("results/figures/{name}.png", name=["breathers", "sensitivity", "fates"]),
    message:
        "The breathers and their figures are there"


rule sensitivity:
    "Which of almost equal data spread, with many members and a long scan: results/breathers/long/"
    input:
        rules.draw_long_sensitivity.output,
    message:
        "The long study of sensitivity is there"


rule fates:
    "The map of fates on a fine grid, which takes minutes: results/breathers/long/"
    input:
        rules.draw_long_fates.output,
    message:
        "The map of fates is there"
