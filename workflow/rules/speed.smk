# Speed against error, and the cost of a run. Not part of the full run: timing jobs run alone.


rule speed:
    "Speed against error of every solver and installed peer, and what runs cost (takes minutes)"
    input:
        datasets("speed", "work_precision", "cost", "pendula"),
        expand("<results>/figures/speed_{regime}.{kind}", regime=REGIMES, kind=FIGURE_KINDS),


use rule dataset as work_precision with:
    "Part of speed: every solver and installed peer on the cases of the paper, timed"
    input:
        kernels(*ALL_SOLVERS),
    pathvars:
        made="speed/work_precision",
    threads: workflow.cores
    params:
        call=function("benchmarks.jobs.measure_work_precision"),
        references=references(*PAPER_CASES),
        problems={case: SETTINGS.problem(case) for case in PAPER_CASES},


use rule dataset as speed_pendula with:
    "Part of speed: every solver and installed peer on Newton's equations, timed"
    pathvars:
        made="speed/pendula",
    threads: workflow.cores
    params:
        call=function("benchmarks.jobs.measure_pendula"),
        problems={case: SETTINGS.problem(case) for case in REGIMES["regular"].cases},


use rule dataset as cost with:
    "Part of speed: chains of increasing length, timed"
    input:
        kernels("dop853", "taylor"),
    pathvars:
        made="speed/cost",
    threads: workflow.cores
    params:
        call=function("benchmarks.jobs.measure_cost"),


use rule figure as speed_figure with:
    "Part of speed: a figure of the timings for each kind of motion"
    input:
        measured="<results>/speed/work_precision.nc",
    pathvars:
        made=f"figures/speed_{{regime,{any_of(REGIMES)}}}",
    params:
        call=function("benchmarks.figures.draw_work_precision"),
        regime="{regime}",


use rule job as reproduction with:
    "The times of the whole reproduction, without and with compiled kernels"
    output:
        data="<results>/speed/reproduction.json",
    pathvars:
        made="speed/reproduction",
    threads: workflow.cores
    params:
        call=function(
            "benchmarks.reproduction.measure_reproduction",
            modules=["pendula.studies.paper.runs"],
        ),
    message:
        "Running the whole reproduction twice, in a copy of the project"
