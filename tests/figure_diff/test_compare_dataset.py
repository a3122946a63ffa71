"""What a trajectory holds must agree with itself, at every time for which it holds the sites."""

import numpy as np
import pytest
from pendula.figure_diff.compare_dataset import AGREE, contradictions
from pendula.figure_diff.hashes import Variable

TAU = np.arange(0, 2.05, 0.1)
SNAPSHOTS = TAU[::2]
MODULI = np.random.default_rng(1).uniform(0.1, 2.0, (2, 7, TAU.size))
"""(component, site, tau)"""


def trajectory(**changed) -> dict[str, Variable]:
    """Return the variables of a trajectory, its moduli in single precision as files hold them."""
    grid = ("component", "tau")
    made = {
        "tau": Variable(("tau",), TAU, {}),
        "snapshot_tau": Variable(("snapshot",), SNAPSHOTS, {}),
        "linf": Variable(grid, MODULI.max(1), {}),
        "l2": Variable(grid, np.sqrt((MODULI**2).sum(1)), {}),
        "modulus": Variable(
            ("component", "site", "snapshot"), MODULI[..., ::2].astype(np.float32), {}
        ),
    }
    return made | {name: made[name]._replace(values=values) for name, values in changed.items()}


def fade(array: np.ndarray, most: float) -> np.ndarray:
    """Raise the second half of the times, slowly and up to this part."""
    return array * (1 + np.clip(TAU - TAU[10], 0, None) / (TAU[-1] - TAU[10]) * most)


def test_what_was_made_together_agrees():
    assert contradictions(trajectory()) == []


@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("l2", lambda l2: fade(l2, 0.2)),
        ("linf", lambda linf: fade(linf, 0.2)),
        ("l2", lambda l2: np.where(TAU > 1, l2[::-1], l2)),
        ("linf", lambda linf: np.where(TAU > 1, linf[::-1], linf)),
        ("l2", lambda l2: np.where(TAU > 1.5, np.nan, l2)),
        ("l2", lambda l2: l2 * (1 + 2 * AGREE)),
    ],
    ids=[
        "l2 fades up by a fifth",
        "linf fades up by a fifth",
        "A and B of l2 exchanged late",
        "A and B of linf exchanged late",
        "late NaN",
        "a little more than single precision",
    ],
)
def test_a_norm_that_leaves_its_moduli_is_named(name, change):
    (said,) = contradictions(trajectory(**{name: change(trajectory()[name].values)}))
    assert said.startswith(f"{name} is off by ") and " at tau = " in said


def test_moduli_that_leave_both_norms_are_named():
    moved = trajectory()["modulus"].values.copy()
    moved[1, :, 7] *= 1.1
    said = contradictions(trajectory(modulus=moved))
    assert len(said) == 2 and all("at tau = 1.4" in each for each in said)


def test_rounding_of_single_precision_is_no_contradiction():
    nudged = trajectory()["l2"].values * (1 + 0.5 * AGREE)
    assert contradictions(trajectory(l2=nudged)) == []


def test_a_dataset_without_sites_contradicts_nothing():
    made = trajectory(l2=np.zeros((2, TAU.size)))
    del made["modulus"]
    assert contradictions(made) == []
