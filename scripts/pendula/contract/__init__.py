"""Tasks of every job: load arguments by the annotations of a function, call it, and write a log."""
