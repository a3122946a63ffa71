"""Configuration files of the replication, laid over each other."""

from functools import partial

from latticode.configuration import files

WHOLE = (*files.WHOLE, "lengths", "end_times", "between")
"""Mappings that are one value: initial data, lengths by half-width, end times by gamma, intervals
by family."""
gather, merge = (partial(function, whole=WHOLE) for function in (files.gather, files.merge))
