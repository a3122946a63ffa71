"""How likely another right run turns a verdict: chaos draws other numbers in each of them.

Two right runs differ in last bits or seeds, and so in each number that rests on chaos. A claim
whose verdict one of twenty of them turns has no verdict. So a test that true data fail by chance
takes the level `RARE`, and the numbers of other criteria must lie far from their limits.
"""

from .cutoff import Cutoff

RARE = Cutoff(1e-5, "the chance of an error of the test: no right run of 10,000 may turn a verdict")
