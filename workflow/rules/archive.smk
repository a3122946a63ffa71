# Everything in one file to deposit. Not part of the full run. Unpacked elsewhere, it holds
# finished results: `snakemake -n` has nothing to do there, `snakemake figures` draws them anew.
ARCHIVE = f"<results>/archive/pendula-{__version__}.tar.gz"


use rule job as archive with:
    "Code, environment, datasets, figures and metadata in one file to deposit"
    input:
        results=lambda wildcards: sorted({*rules.all.input, *kernels(*COMPILED)}),
    output:
        archive=ARCHIVE,
        checksum=f"{ARCHIVE}.sha256",
    pathvars:
        made="archive",
    params:
        call=function("pendula.archive.pack.pack_results"),
        made_by=lambda wildcards: code_of_jobs(),
        digests=lambda wildcards: {name: digest_of(PROJECT / name) for name in code_files(PROJECT)},
        configuration=lambda wildcards: config,
