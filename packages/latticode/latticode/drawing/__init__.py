"""Figures of runs, sweeps, surveys and localised states: their style, files and descriptions."""
