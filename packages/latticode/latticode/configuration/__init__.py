"""The configuration of cases, sweeps and surveys: its keys, the cost of runs, and its errors."""
