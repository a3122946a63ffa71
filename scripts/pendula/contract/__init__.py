"""What every job does: load the arguments of a function by its annotations, call it, keep a log."""
