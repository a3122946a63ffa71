"""Stands for the program `snakemake` in the clone in which the printed commands are run.

It asks for a fork of tests/ready_snakemake.py with its own folder, variables and screen, and ends
as that fork did: nearly half of most commands would be imports. `printed.py` passes on what this
program asks for.
"""

import json
import os
import sys
from pathlib import Path

BESIDE = Path(__file__).resolve().parents[3]
"""The folder of the clone, which is beside the two pipes."""

if __name__ == "__main__":
    screens = [f"/proc/{os.getpid()}/fd/{number}" for number in (1, 2)]
    request = [os.getcwd(), dict(os.environ), screens, ["snakemake", *sys.argv[1:]]]
    with open(BESIDE / "asked", "w") as asked, open(BESIDE / "answered") as answered:
        asked.write(json.dumps(request) + "\n")
        asked.flush()
        sys.exit(int(answered.readline()))
