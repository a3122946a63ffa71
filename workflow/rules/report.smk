# One page on the whole run, and one that runs the paper's solver in a browser.


use rule job as report with:
    "results/report.html: what the run found, figure by figure and claim by claim, on one page"
    input:
        datasets=DATASETS,
        figures=expand("<results>/figures/{name}.nc", name=FIGURES),
        ledger="<results>/claims.json",
    output:
        html="<results>/report.html",
    pathvars:
        made="report",
    params:
        call=function("pendula.report.document.write_report"),
        differs=DIFFERS,


use rule job as live with:
    "results/live.html: a page that integrates the cases of Figs 2 to 4, and compares their bits"
    input:
        runs=runs_by("ode45"),
        trust="<results>/checks/trust.nc",
    output:
        html="<results>/live.html",
    pathvars:
        made="live",
    params:
        call=function("pendula.live.write.write_live"),
