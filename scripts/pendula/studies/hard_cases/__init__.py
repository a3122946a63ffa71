"""Hard cases: runs in which solvers are most likely to fail, and their measured errors.

No run may hang or return noise: it ends with a result of known error or with a message.
"""
