"""Measurements of speed against error, and of the cost of runs; no reproduction repeats them."""
