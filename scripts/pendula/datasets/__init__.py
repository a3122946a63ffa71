"""Datasets on disk: reading and writing them, and what their variables are called."""
