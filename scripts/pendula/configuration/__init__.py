"""The validated configuration: its keys and allowed values, and messages on invalid ones."""
