# One page on the whole run, that opens anywhere.

SPEED_IS_FRESH, SPEED_DATA, SPEED_TABLE, SPEED_PICTURES = speed_measured()


rule report:
    "results/report.html: what the run found, figure by figure and claim by claim, on one page"
    input:
        code=code("report/write_report.py", "section"),
        datasets=reported_datasets(),
        pictures=expand("results/figures/{name}.png", name=FIGURES),
        ledger="results/claims.json",
        speed_data=SPEED_DATA,
        speed_table=SPEED_TABLE,
        speed_pictures=SPEED_PICTURES,
        sources=[
            *map(code, NUMBERS_BY),
            *CLAIMS_CODE.values(),
            *references(*PAPER_CASES, "fig4_small.double"),
        ],
    output:
        html="results/report.html",
    log:
        "results/logs/report.log",
    conda:
        "../envs/pinned.yaml"
    params:
        speed_is_fresh=SPEED_IS_FRESH,
        settings=settings_in_words(),
        differs=DIFFERS,
        logs="results/logs",
    message:
        "Writing the report"
    script:
        "../../scripts/report/write_report.py"
