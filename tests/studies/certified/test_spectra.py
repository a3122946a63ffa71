"""Proofs of stability: what boxes of eigenvalues say, and spectra against dense matrices."""

import numpy as np
import pytest
from flint import acb, arb
from pendula.models.pairs import FAMILIES
from pendula.studies.certified import balls, spectra
from pendula.studies.certified.existence import Chain
from pendula.studies.certified.proved_breathers import find
from pendula.studies.certified.spectra import Verdict, judge

REAL, EQUAL, ASYMMETRIC, IMAGINARY, ASYMMETRIC_IMAGINARY = FAMILIES
HERE = Chain(epsilon=1.0, gamma=1.0, omega=-4.0, half_width=8)


def box(real, imag=0.0, radius=1e-3):
    return acb(arb(real, radius), arb(imag, radius))


@pytest.mark.parametrize(
    ("boxes", "zero", "verdict"),
    [
        ([box(-1), box(-2)], False, Verdict.STABLE),
        ([box(-1), box(2)], False, Verdict.UNSTABLE),
        ([box(-1, 0.5), box(-1, -0.5)], False, Verdict.UNSTABLE),
        ([box(-1), box(0)], False, Verdict.UNDECIDED),
        ([box(-1), box(0)], True, Verdict.STABLE),
        ([box(-1), box(0), box(1)], True, Verdict.UNSTABLE),
        # one box meets the axis, the conjugate of its eigenvalue lies in the other, which does not
        ([box(-1, 0.0009), box(-1.0005, -0.0012)], False, Verdict.UNSTABLE),
        ([box(-1), box(-1)], False, Verdict.UNDECIDED),  # not isolated
        (None, False, Verdict.UNDECIDED),
    ],
)
def test_boxes_decide(boxes, zero, verdict):
    assert judge(boxes, zero) is verdict


def exponents(chain, family, state):
    """Return all exponents of a state on the whole chain, from one dense matrix in doubles."""
    s, whole = family.drive(chain.gamma), np.concatenate([state[:, :0:-1], state], axis=1)
    one = np.eye(whole.shape[1])
    neighbours = np.eye(len(one), k=1) + np.eye(len(one), k=-1) - 2.0 * one
    linear = np.kron(np.eye(2), chain.epsilon * neighbours + chain.omega * one)
    exchange = s * np.kron([[1.0, -1.0], [-1.0, 1.0]], one)
    squares, zero = np.diag(whole.ravel() ** 2), np.zeros_like(linear)
    lower, upper = linear + 0.5 * squares + exchange, linear + 1.5 * squares - exchange
    return np.linalg.eigvals(np.block([[zero, lower], [-upper, zero]]))


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
def test_the_blocks_have_the_spectrum_of_the_whole_chain(family):
    state = find(1.0, HERE.half_width, {"family": family.name, **HERE._asdict()})[-1]
    with balls.precision():
        u = [[arb(float(x)) for x in row] for row in state]
        blocks = [b for even in (True, False) for b, _ in spectra.blocks(HERE, family, u, even)]
        boxes = [y for block in blocks for y in spectra.eigenvalues(block)]
        total = sum((block.trace() for block in blocks), arb(0))
        assert sum(boxes, acb(0)).overlaps(acb(total))
    found = np.array([complex(float(y.real.mid()), float(y.imag.mid())) for y in boxes])
    squares = exponents(HERE, family, state) ** 2
    assert 2 * len(found) == len(squares)
    assert max(np.abs(found - y).min() for y in squares) < 1e-6
    assert max(np.abs(squares - y).min() for y in found) < 1e-6
