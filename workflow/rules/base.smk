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
    group:
        "files"
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
    group:
        "datasets"
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
    group:
        "figures"
    conda:
        "../envs/pinned.yaml"
    params:
        code=digest("figure.py"),
        differs=differs_of,
    message:
        "Drawing {output[0]}"
    script:
        "../../scripts/figure.py"


use rule job as decide_claims with:
    "Base of a part of the ledger: its claims with their verdicts, and a table to read"
    output:
        part="<results>/claims/<part>.json",
        table="<results>/tables/claims_<part>.md",
    log:
        "<logs>/claims/<part>.log",
    pathvars:
        part="{part,(?!)}",
    params:
        makers=lambda wildcards, input: {name_of(path): maker_of(path) for path in input.datasets},
        differs=lambda wildcards, input: concerning(DIFFERS, map(name_of, input.datasets)),
    message:
        "Deciding claims: {output.table}"
