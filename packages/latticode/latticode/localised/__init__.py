"""States that stay at their place, and what becomes of small perturbations of them."""
