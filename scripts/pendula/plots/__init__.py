"""The figures: each module gathers what it draws into a dataset, and draws from that alone."""
