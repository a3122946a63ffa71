"""Hard cases: where a solver is most likely to fail, what it does there, and how one knows.

Nothing may hang and nothing may return noise as a result: an outcome is a result with its error, or
a rejection with a message.
"""
