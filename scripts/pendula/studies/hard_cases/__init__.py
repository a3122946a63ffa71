"""Hard cases: where a solver is most likely to fail, what it does there, and how one knows.

config/hard_cases.yaml declares them, `errors` measures, `outcomes` runs them all.
Nothing may hang and nothing may return noise as a result: an outcome is digits with an error, or a
refusal in words.
"""
