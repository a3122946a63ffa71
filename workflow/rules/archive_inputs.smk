# What an archive takes in: all that is made, and all that it was made from.


def deposited(wildcards):
    """Return what `rule all` makes, and all that its figures are drawn from."""
    between = [f"results/{name}.nc" for name in makers()]
    apart = [*rules.hard_cases.output, *kernels(*ALL_SOLVERS)]
    copies = handed_out.difference(records(wildcards))  # complete only when every rule is read
    return sorted({*rules.all.input, *between, *apart, *copies})


def records(wildcards):
    return sorted(path for path in handed_out if path.endswith(".txt"))


def record_of_project(wildcards):
    try:
        return whole_project()
    except ArchiveError as error:
        raise WorkflowError(str(error)) from None
