"""How many bits each case takes: the workflow reads it, and needs no solver for that."""

# Bits of the run that is stored, and of the one that checks it. Chaos takes e^{growth tau}.
BITS = {
    "fig2_small": (128, 112),  # regular: 3 of 39 digits are lost
    "fig2_large": (128, 112),  # regular
    "fig3_small": (128, 112),  # regular
    "fig3_large": (288, 272),  # growth 2.65 from tau = 20 on: 58 of 86 digits by tau = 70
    "fig4_small": (192, 176),  # growth 1.8: 35 of 58 digits by tau = 50
    "fig4_large": (192, 176),  # growth 1.8: 35 of 58 digits by tau = 50
}
