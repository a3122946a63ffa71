"""Cases and sweeps of one's own: checks, figures and a page of their own."""
