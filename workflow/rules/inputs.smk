# What the rules take in, study by study: paths, and plain values of the configuration. The functions
# stand apart from the rules, so that a file of rules reads as a list of them.
include: "inputs/own.smk"
include: "inputs/datasets.smk"
include: "inputs/unbounded.smk"
include: "inputs/chaos.smk"
include: "inputs/breathers.smk"
include: "inputs/pendula.smk"
include: "inputs/certified.smk"
include: "inputs/report.smk"
include: "inputs/claims.smk"
