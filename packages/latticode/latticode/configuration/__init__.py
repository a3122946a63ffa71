"""The configuration of cases and sweeps: what may stand in it, what a run costs, its errors."""
