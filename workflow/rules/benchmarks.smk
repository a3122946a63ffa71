# Measurements of speed; not part of the full run, since timing jobs must run alone.


rule benchmark:
    "Speed: the solvers against SciPy, and the whole reproduction (takes minutes; run it alone)"
    input:
        "results/benchmarks/solvers.md",
        "results/benchmarks/reproduction.md",


rule measure:
    input:
        program=f"{workflow.basedir}/tests/benchmarks/{{what}}.py",
        code=code("trajectories/simulate_case.py"),
    output:
        table="results/benchmarks/{what}.md",
    log:
        "results/logs/benchmarks/{what}.log",
    wildcard_constraints:
        what="solvers|reproduction",
    conda:
        "../envs/pinned.yaml"
    threads: workflow.cores
    params:
        python=sys.executable,
    message:
        "Measuring {wildcards.what}"
    shell:
        "{params.python:q} {input.program:q} > {output.table:q} 2> {log:q} && cat {output.table:q}"
