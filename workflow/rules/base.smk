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
        environment("pinned")
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
        environment("pinned")
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
        environment("pinned")
    params:
        code=digest("figure.py"),
        differs=differs_of,
    message:
        "Drawing {output[0]}"
    script:
        "../../scripts/figure.py"


# Many runs are made in parts if --config chunks= asks for it: by jobs that fill the cores here and the nodes
# of a cluster. A part that is there is not made again; the number of parts changes no bit.


use rule dataset as part with:
    "A part of the runs of a dataset: results/{whole}.parts/{part}-of-{parts}.nc"
    input:
        kernels=lambda wildcards: given_to(wildcards.whole)[1],
    pathvars:
        made="{whole}.parts/{part,[0-9]+}-of-{parts,[0-9]+}",
    resources:
        **asked(cost_of_part),
    params:
        call=lambda wildcards: given_to(wildcards.whole)[0]["call"],
        given=lambda wildcards: given_to(wildcards.whole)[0],
        chunk=lambda wildcards: [int(wildcards.part), int(wildcards.parts)],
