"""Hard cases: where a solver is most likely to fail, what it does there, and how one knows.

`rows` declares them, `against_exact` and `against_runs` decide them, `table` runs and writes them.
Nothing may hang and nothing may return noise as a result: an outcome is digits with an error, or a
refusal in words.
"""
