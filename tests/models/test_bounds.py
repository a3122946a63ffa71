"""What is read off one run: P, drift, and the margin to the bound (19)."""

import numpy as np
import pytest
from pendula.models.bounds import growth_margin


def test_the_bound_is_seen_from_both_ends():
    """P may neither grow nor fall faster than e^(4 gamma tau), whichever end is given."""
    tau, gamma = np.linspace(0.0, 2.0, 21), 0.5
    for rate, forth in ((2.0, 1.0), (-2.0, np.exp(-0.4)), (4.0, np.exp(4.0)), (0.0, np.exp(-0.2))):
        margins = growth_margin(tau, np.sqrt(0.5 * np.exp([rate * tau, rate * tau])), gamma)
        assert margins["from_start"] == pytest.approx(forth)
        assert margins["steepest"] == pytest.approx(abs(rate) / 2.0)
