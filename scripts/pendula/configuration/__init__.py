"""The validated configuration: what may stand in it, and its faults in words."""
