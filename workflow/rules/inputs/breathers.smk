# Breathers.
BREATHERS_PARTS = ["steady", "periodic", "growth", "sensitivity", "fates"]
# The maps of `snakemake fates` as they are committed
FINE_MAPS = "tests/baseline/quoted/breathers.nc"


def cases_on_one_pair():
    """Return the paper's cases that have real data on one pair."""

    def on_one_pair(initial):
        (site, pair), *others = initial.items()
        return not (others or site or any(complex(one).imag for one in pair))

    return [case for case in PAPER_CASES if on_one_pair(SETTINGS.problem(case)["initial"])]
