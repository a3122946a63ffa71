"""The moving picture of the README shows the chain that it says."""

import re

import moving_chain
import numpy as np
from helpers import ROOT
from latticode.simulation.simulate import simulate
from problems import problem_of


def test_pendula_swing_by_the_amplitudes_of_another_solver():
    angles = moving_chain.swing_angles()
    assert angles.shape == (169, 2, 21)
    assert np.array_equal(angles, angles[:, :, ::-1])
    run = simulate(problem_of("fig4_small", end_time=5.0, snapshot_every=0))
    swing = np.degrees(2 * moving_chain.MU * run.final[:, 20:41].real)  # a whole number of swings
    assert np.abs(angles[5 * moving_chain.FRAMES_PER_SECOND] - swing).max() < 1e-3
    assert np.abs(angles).max() < 90


def test_every_pendulum_has_all_frames():
    picture = (ROOT / "docs/moving_chain.svg").read_text(encoding="utf-8")
    series = re.findall(r'values="([^"]*)"', picture)
    assert len(series) == 42 and {len(values.split(";")) for values in series} == {169}
