"""Speed against error, and the cost of a run: measurements, which no reproduction repeats."""
