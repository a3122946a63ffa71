# What jobs share. A rule of a study is one of these with its name, what it takes and what it calls:
# `made` is its place below the results, which names its output and its log too. No file has the name
# that these three ask for, so that none is a target.


rule job:
    "Base of a job whose function reads and writes files itself"
    output:
        "<results>/<made>",
    log:
        "<logs>/<made>.log",
    pathvars:
        made="{made,(?!)}",
    conda:
        "../envs/pinned.yaml"
    params:
        code=digest("call.py"),
    message:
        "Writing {output}"
    script:
        "../../scripts/call.py"


rule dataset:
    "Base of a job that computes a dataset: the function returns what to write"
    output:
        "<results>/<made>.nc",
    log:
        "<logs>/<made>.log",
    pathvars:
        made="{made,(?!)}",
    conda:
        "../envs/pinned.yaml"
    params:
        code=digest("dataset.py"),
    message:
        "Computing {output}"
    script:
        "../../scripts/dataset.py"


rule figure:
    "Base of a job that draws a figure: gather_... returns what draw_... draws"
    output:
        figure_files("<results>/<made>"),
    log:
        "<logs>/<made>.log",
    pathvars:
        made="{made,(?!)}",
    priority: -1  # after datasets, of which the last are followed by claims, one after the other
    conda:
        "../envs/pinned.yaml"
    params:
        code=digest("figure.py"),
        differs=differs_of,
    message:
        "Drawing {output[0]}"
    script:
        "../../scripts/figure.py"
