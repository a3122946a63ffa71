"""Newton's equations (1) of the pendula compared with the amplitude equations (4)."""
