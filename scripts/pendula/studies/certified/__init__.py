"""Numbers with a proof: how far computed curves can be from the true ones, and what exists."""
