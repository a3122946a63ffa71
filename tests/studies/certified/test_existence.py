"""Existence proofs of breathers: the inequalities against dense matrices, and what is refused."""

import numpy as np
import pytest
from flint import arb, arb_mat, ctx
from pendula.models.pairs import FAMILIES
from pendula.studies.certified import existence
from pendula.studies.certified.existence import ProofChain, ProofFailedError, prove
from pendula.studies.certified.proved_breathers import compute_state

REAL, EQUAL, ASYMMETRIC, IMAGINARY, ASYMMETRIC_IMAGINARY = FAMILIES
CHAIN = ProofChain(epsilon=1.0, gamma=1.0, omega=-4.0, half_width=18)
FAR = CHAIN._replace(half_width=22)


def find_state(chain, family):
    return compute_state(chain.gamma, chain.half_width, {"family": family.name, **chain._asdict()})[
        -1
    ]


def proved(family, chain, state):
    return prove(chain, family.drive(chain.gamma), state)


def better(chain, s, state):
    """Return the state of a finite chain to some sixty digits, by Newton's method."""
    u = arb_mat([[arb(float(x))] for x in state])
    for _ in range(2):
        values = u.entries()
        k, miss = (
            existence.make_derivative(chain, s, values),
            existence.make_residual(chain, s, values),
        )
        u = (u - k.mid().solve(miss.mid())).mid()
    return u.entries()


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
def test_the_true_state_lies_within_the_radius_and_not_within_a_small_part_of_it(family):
    """The state of a far longer chain stands for that of the infinite one."""
    longer = np.zeros((2, FAR.half_width + 1))
    longer[:, : CHAIN.half_width + 1] = state = find_state(CHAIN, family)
    full_state = np.concatenate([longer[:, :0:-1], longer], axis=1).ravel()
    with ctx.workprec(200):
        true = better(FAR, family.drive(FAR.gamma), full_state)
        distance = max(
            float(abs(x - arb(y)).upper()) for x, y in zip(true, full_state, strict=True)
        )
    radius = proved(family, CHAIN, state)
    assert distance <= radius < 1e-10
    assert radius < 20.0 * distance


def dense(chain, s, u, extra):
    """Return A and DF(u) on a chain longer by `extra` at both sides, and u there, in doubles.

    A is the inverse on the block, and C^-1 at each site beyond.
    """
    longer = chain._replace(half_width=chain.half_width + extra)
    sites = 2 * longer.half_width + 1
    wide = np.zeros((2, sites))
    wide[:, extra:-extra] = u
    slope = existence.make_derivative(longer, s, [arb(float(x)) for x in wide.ravel()])
    df = np.array([[float(x.mid()) for x in row] for row in slope.tolist()])
    block = np.arange(extra, sites - extra)
    block = np.concatenate([block, block + sites])
    a = np.zeros_like(df)
    a[np.ix_(block, block)] = np.linalg.inv(df[np.ix_(block, block)])
    outer = chain.omega - s - 2.0 * chain.epsilon
    for n in [*range(extra), *range(sites - extra, sites)]:
        both = np.ix_([n, n + sites], [n, n + sites])
        a[both] = np.linalg.inv([[outer, s], [s, outer]])
    miss = existence.make_residual(longer, s, [arb(float(x)) for x in wide.ravel()]).entries()
    return a, df, wide.ravel(), np.array([float(x.mid()) for x in miss])


@pytest.mark.parametrize("s", [1.0, -1.0])
@pytest.mark.parametrize("scale", [0.3, 1.5, 4.0, 30.0])
@pytest.mark.parametrize(("epsilon", "half_width"), [(1.0, 2), (-1.0, 2), (1.0, 0)])
def test_the_estimates_are_norms_of_longer_dense_matrices(s, scale, epsilon, half_width):
    """Also of what is no state, where now the block and now the outside decides.

    On a block of one site both neighbours beyond act on that site.
    """
    chain = CHAIN._replace(epsilon=epsilon, omega=-4.0 * epsilon, half_width=half_width)
    u = scale * np.random.default_rng(3).uniform(-1.0, 1.0, (2, 2 * half_width + 1))
    with ctx.workprec(existence.BITS):
        a, df, wide, miss = dense(chain, s, u, 4)
        estimates = existence.make_estimates(chain, s, [arb(float(x)) for x in u.ravel()])
        eta, z, bent, cubic = (float(ball.upper()) for ball in estimates)

    def norm(matrix):
        return np.abs(matrix).sum(axis=1).max()

    assert z == pytest.approx(norm(np.eye(len(df)) - a @ df), rel=1e-9)
    assert eta == pytest.approx(np.abs(a @ miss).max(), rel=1e-9)
    assert bent == pytest.approx(3.0 * norm(a * wide), rel=1e-9)
    assert cubic == pytest.approx(1.5 * norm(a), rel=1e-9)


# --- Refusals -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("family", "omega"), [(EQUAL, 0.0), (EQUAL, 2.0), (EQUAL, 4.0), (REAL, 5.0), (IMAGINARY, -1.0)]
)
def test_inside_a_band_the_outside_does_not_contract(family, omega):
    """[0, 4 epsilon] for sums, shifted by 2 s for differences."""
    with pytest.raises(ProofFailedError, match="band"):
        proved(family, CHAIN._replace(omega=omega), find_state(CHAIN, family))


def test_a_worse_state_has_a_larger_radius_and_a_wrong_one_is_refused():
    state = find_state(CHAIN, EQUAL)
    off = np.array([1e-10, 1e-6, 1e-3])
    radii = [proved(EQUAL, CHAIN, state * (1.0 + error)) for error in off]
    sizes = np.abs(state).max() * off
    assert np.all(radii >= sizes) and np.all(radii < 3.0 * sizes)
    with pytest.raises(ProofFailedError, match="residual"):
        proved(EQUAL, CHAIN, 1.3 * state)
    with pytest.raises(ProofFailedError, match="zero"):
        proved(EQUAL, CHAIN, 0.0 * state)


def test_a_ball_that_is_mapped_into_itself_must_be_contracted_too():
    """p has its roots at 0.4975 and 0.5025: just below the second one p < 0, but q > 1."""
    with ctx.workprec(existence.BITS):
        eta = arb(0.4975) * arb(0.5025) / 2
        estimates = existence.Estimates(eta, arb(0.5), arb(1), arb(1e-12))
        with pytest.raises(ProofFailedError, match="residual"):
            existence.find_radius(estimates)
        assert 0.342 < existence.find_radius(estimates._replace(eta=0.9 * eta)) < 0.36
        with pytest.raises(ProofFailedError, match="residual"):  # p(0.202) = 0.002, q < 1
            existence.find_radius(estimates._replace(eta=arb(0.08), cubic=arb(1)))


def test_the_sign_of_epsilon_does_not_open_a_band():
    """For epsilon = -1 it is [-4, 0]."""
    with pytest.raises(ProofFailedError, match="band"):
        proved(EQUAL, CHAIN._replace(epsilon=-1.0, omega=-3.0), find_state(CHAIN, EQUAL))
