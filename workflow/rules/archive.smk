# Everything in one file to deposit. Not part of the full run. Unpacked elsewhere, it holds
# finished results: `snakemake -n` has nothing to do there, `snakemake figures` draws them anew.

ARCHIVE = f"results/archive/pendula-{__version__}.tar.gz"


rule archive:
    "Code, environment, datasets, figures and metadata in one file to deposit"
    input:
        code=record_of_project,
        results=deposited,
        records=records,
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
