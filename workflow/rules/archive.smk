# Everything in one file to deposit. Not part of the full run. Unpacked elsewhere, it holds
# finished results: `snakemake -n` has nothing to do there, `snakemake figures` draws them anew.

ARCHIVE = f"results/archive/pendula-{__version__}.tar.gz"
DRAWN_FROM = [
    *(f"results/{name}.nc" for name in makers()),
    *rules.hard_cases.output,
    *kernels(*ALL_SOLVERS),
]


rule archive:
    "Code, environment, datasets, figures and metadata in one file to deposit"
    input:
        # Functions, since the records and copies are complete only when every rule has been read.
        code=lambda wildcards: whole_project(),
        results=lambda wildcards: sorted({*rules.all.input, *DRAWN_FROM, *copies()}),
        records=lambda wildcards: records(),
    output:
        archive=ARCHIVE,
        checksum=f"{ARCHIVE}.sha256",
    log:
        "results/logs/archive.log",
    conda:
        "../envs/pinned.yaml"
    params:
        configuration=lambda wildcards: config,
    message:
        "Packing code, environment, datasets and figures"
    script:
        "../../scripts/archive/pack_results.py"
