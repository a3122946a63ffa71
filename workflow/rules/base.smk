# What jobs share. A rule of a study is one of these with its name, what it takes and what it calls:
# `made` is its place below the results, which names its output and its log too. No file has the name
# that these three ask for, so that none is a target.


rule job:
    output:
        "<results>/<made>",
    log:
        "<logs>/<made>.log",
    "Base of a job whose function reads and writes files itself"
    pathvars:
        made="{made,(?!)}",
    conda:
        "../envs/pinned.yaml"
    params:
        code=digest("call.py"),
    script:
        "../../scripts/call.py"


rule dataset:
    output:
        "<results>/<made>.nc",
    log:
        "<logs>/<made>.log",
    "Base of a job that computes a dataset: the function returns what to write"
    pathvars:
        made="{made,(?!)}",
    conda:
        "../envs/pinned.yaml"
    params:
        code=digest("dataset.py"),
    script:
        "../../scripts/dataset.py"


rule figure:
    output:
        files_of("<results>/<made>"),
    log:
        "<logs>/<made>.log",
    "Base of a job that draws a figure: gather_... returns what draw_... draws"
    pathvars:
        made="{made,(?!)}",
    conda:
        "../envs/pinned.yaml"
    params:
        code=digest("figure.py"),
    script:
        "../../scripts/figure.py"
