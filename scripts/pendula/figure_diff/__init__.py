"""Compares what a run made with the accepted baseline: data, images, and one page about both."""
