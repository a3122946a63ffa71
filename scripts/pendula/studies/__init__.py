"""The studies: each has a folder here, rules in workflow/rules, and a configuration of its own."""

CONFIGURED = ("theory", "chaos", "unbounded", "reference")
"""Studies with choices of their own: config/<name>.yaml holds them, <name>/settings.py says what
may stand in it."""
