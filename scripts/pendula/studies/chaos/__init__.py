"""Chaos in the chain: how fast small errors grow, and what that leaves to be trusted."""
