"""Free ends as mirrors between sites, for equations that look two and three sites far."""

from pathlib import Path

import numpy as np
import pytest
from latticode import Case, Model, abs2, shift, simulate
from scipy.integrate import solve_ivp

M, END = 5, 3.0
START = np.random.default_rng(7).normal(size=(2, 2 * M + 1)) * 0.5
PAGE = Path(__file__).resolve().parents[2] / "docs/equations.md"


def mirrored(u, by):
    """Return the values at the sites n + by, those beyond an end as a mirror shows them."""
    return np.concatenate([u[::-1], u, u[::-1]])[u.size + by : 2 * u.size + by]


def final(i_dt, **parameters):
    """Return the fields at the end of a run on a chain with free ends."""
    model = Model(fields="u", parameters=parameters, i_dt=i_dt)
    initial = {int(n) - M: [complex(*START[:, n])] for n in range(2 * M + 1)}
    case = Case(model=model, half_width=M, boundary="free", initial=initial, end_time=END)
    real, imaginary = simulate(case)["final"].values[:, 0]
    return real + 1j * imaginary


def solved(slope):
    start = START[0] + 1j * START[1]
    run = solve_ivp(
        lambda t, u: -1j * slope(u), (0, END), start, method="DOP853", rtol=1e-12, atol=1e-13
    )
    return run.y[:, -1]


@pytest.mark.parametrize("reach", [1, 2, 3])
def test_free_ends_are_a_mirror_between_sites(reach):
    def i_dt(p, u):
        return shift(u, reach) - 0.3 * shift(u, -reach) + abs2(shift(u, reach)) * u

    def slope(u):
        right, left = mirrored(u, reach), mirrored(u, -reach)
        return right - 0.3 * left + abs(right) ** 2 * u

    np.testing.assert_allclose(final(i_dt), solved(slope), rtol=0, atol=1e-10)


@pytest.mark.parametrize(("reach", "added"), [(1, []), (2, [(0, 1)]), (3, [(0, 2)])])
def test_neighbours_of_each_reach_get_the_bonds_that_the_page_names(reach, added):
    """The matrix of all bonds: within the chain, and those that the mirror adds at both ends."""
    last = 2 * M
    bonds = [(n, n + reach) for n in range(last + 1 - reach)]
    bonds += [bond for n, m in added for bond in ((n, m), (last - n, last - m))]
    matrix = np.zeros((last + 1, last + 1))
    for n, m in bonds:
        matrix[[n, m], [m, n]] += 1.0
        matrix[[n, m], [n, m]] -= 1.0
    computed = final(lambda p, u: shift(u, reach) + shift(u, -reach) - 2 * u)
    np.testing.assert_allclose(computed, solved(lambda u: matrix @ u), rtol=0, atol=1e-10)


def test_the_picture_on_the_page_is_that_of_the_mirror():
    sites, values = (
        line.split() for line in PAGE.read_text().splitlines() if " M  " in line or "u(M)" in line
    )
    chain = np.array(["u(M-4)", "u(M-3)", "u(M-2)", "u(M-1)", "u(M)"])
    beyond = [mirrored(chain, by)[-1] for by in (1, 2, 3)]
    assert sites == ["site", "M-2", "M-1", "M", "|", "M+1", "M+2", "M+3"]
    assert values == ["its", "value", *chain[-3:], "|", *beyond]
    assert "**a bond between the last two sites is added**" in PAGE.read_text()


def test_bonds_across_an_end_are_cut_by_parameters_as_the_page_does():
    def i_dt(p, u):
        return p.right * (shift(u, 2) - u) + p.left * (shift(u, -2) - u)

    parameters = {
        "right": lambda n: (n + 2 <= n.max()) * 1.0,
        "left": lambda n: (n - 2 >= n.min()) * 1.0,
    }
    matrix = np.diag(np.ones(2 * M - 1), 2) + np.diag(np.ones(2 * M - 1), -2)
    matrix -= np.diag(matrix.sum(axis=1))
    np.testing.assert_allclose(
        final(i_dt, **parameters), solved(lambda u: matrix @ u), rtol=0, atol=1e-10
    )
