# What an archive takes in: all that is made, and all that it was made from.


def deposited(wildcards):
    """Return what `rule all` makes, and every dataset that its figures are drawn from."""
    between = [f"results/{name}.nc" for name in makers()]
    apart = [*rules.hard_cases.output, *kernels(*ALL_SOLVERS)]
    return sorted({*rules.all.input, *between, *apart})


def records_and_copies(wildcards):
    return sorted(handed_out)  # complete only when every rule is read


def record_of_project(wildcards):
    try:
        return whole_project()
    except ArchiveError as error:
        raise WorkflowError(str(error)) from None
