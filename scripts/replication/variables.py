"""Words for the variables of datasets, which the comparison, the ledger and the article read."""

VARIATION = "variation"
"""The dimension of a number's values that were measured again with other choices."""
