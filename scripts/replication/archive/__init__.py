"""Packs code, environment, datasets and figures into one file to deposit, with its metadata."""
