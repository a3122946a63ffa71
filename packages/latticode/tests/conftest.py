"""How hypothesis draws in the tests of the library: the same data every time, no time limit."""

from hypothesis import settings

settings.register_profile(
    "latticode", deadline=None, derandomize=True, database=None, max_examples=50
)
settings.load_profile("latticode")
