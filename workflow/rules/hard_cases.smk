# What the solvers do where they are most likely to fail.


use rule dataset as hard_cases with:
    "Hard cases: digits with their error, or a refusal in words, of every solver"
    input:
        kernels=kernels(*ALL_SOLVERS),
    pathvars:
        made="checks/hard_cases",
    params:
        call=function("pendula.studies.hard_cases.outcomes.hard_cases_contents"),
        cases=SETTINGS.hard_cases.plain(),
