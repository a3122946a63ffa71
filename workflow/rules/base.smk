# Base rules of all jobs. A rule of a study uses one of them, and adds its name, its inputs and its function. `made`
# is its path below results/, from which its output and log are named. In these three base rules the pattern matches
# no file name, so that none can be run as a target.
#
# Named inputs and parameters are the arguments of the function. Its annotations decide which of them are loaded as
# datasets or problems (scripts/pendula/contract/arguments.py). The job waits for an input without a name, such as a
# kernel. These are not arguments: `call` (the function, with a hash of its code), `code` (a hash of the script),
# `unlike_paper` of a figure, and the input `chunks`, the files into which the runs of a study are split.


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
        code=script_digest("call.py"),
    message:
        "Writing {output}"
    script:
        "../../scripts/call.py"


rule dataset:
    "Base of a job that computes a dataset: the function returns what to write"
    output:
        dataset_outputs("<results>/<made>.nc"),
    log:
        "<logs>/<made>.log",
    pathvars:
        made="{made,(?!)}",
    conda:
        environment("pinned")
    params:
        code=script_digest("dataset.py"),
    message:
        "Computing {output}"
    script:
        "../../scripts/dataset.py"


rule figure:
    "Base of a job that draws a figure: gather_... returns what draw_... draws"
    output:
        figure_outputs("<results>/<made>"),
    log:
        "<logs>/<made>.log",
    pathvars:
        made="{made,(?!)}",
    priority: -1  # datasets first: the last ones are followed by claims, which run one after another
    conda:
        environment("pinned")
    params:
        code=script_digest("figure.py"),
        unlike_paper=differs_of,
    message:
        "Drawing {output[0]}"
    script:
        "../../scripts/figure.py"
