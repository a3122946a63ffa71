"""The long studies that the article quotes, and the commands that repeat them."""

from replication.article.quoted import FOLDER, LongStudies, LongStudy

UNBOUNDED, PROOFS = f"{FOLDER}/unbounded", f"{FOLDER}/proofs"
SPEED, TIMES = f"{FOLDER}/speed/work_precision", f"{FOLDER}/reproduction.json"
LONG_STUDIES: LongStudies = {
    UNBOUNDED: LongStudy("snakemake unbounded"),
    f"{FOLDER}/chaos": LongStudy(
        "snakemake transition", "pendula.studies.chaos.lifetimes.vary_lifetimes"
    ),
    f"{FOLDER}/breathers": LongStudy(
        "snakemake fates sensitivity", "pendula.studies.breathers.other_choices.vary_areas"
    ),
    f"{FOLDER}/pendula": LongStudy(
        "snakemake over_the_top", "pendula.studies.newton.over_the_top.vary_over_the_top"
    ),
    PROOFS: LongStudy("snakemake certified", "pendula.studies.certified.contents.certify_curve"),
    SPEED: LongStudy("snakemake speed"),
    TIMES: LongStudy("snakemake reproduction", "benchmarks.reproduction.measure_reproduction"),
}
"""By the name, or by the folder, of the copies that the article quotes."""
