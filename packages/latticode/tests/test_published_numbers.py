"""Numbers that others have published, measured as a user would: a model, a case, a run.

Each test names its source, and in a comment the wrong signs and coefficients at which it was seen
to fail. Systems without neighbours are one site, `half_width=0`. A ring of 40 sites is eight fields
on five sites, since a chain has 2M + 1.
"""

import numpy as np
import pytest
from latticode import Case, Model, abs2, exp, lap, simulate, sqrt, survey
from latticode.checks import check_breather, follow
from latticode.measures.growth import is_chaotic, mean_rate, mean_rate_error


def problem_of(case):
    return case.kind.of(case.problem())


def rate(function):
    """Return equations in the form of `i_dt` from the rates of real fields."""

    def i_dt(p, *fields):
        return tuple(1j * value for value in function(p, *(field.real for field in fields)))

    return i_dt


def exponent_of(case):
    """Return the largest Lyapunov exponent, its standard error, and whether the motion is chaotic.

    The error is that of the means over eight consecutive parts of the run, each much longer than
    the growth is correlated.
    """
    growth = follow(problem_of(case))
    tau, logarithm = growth.tau, growth.log_growth[0]
    middle = tau[-1] / 2
    value, error = (measure(tau, logarithm, middle) for measure in (mean_rate, mean_rate_error))
    return float(value), float(error), bool(is_chaotic(tau, logarithm, growth.size))


# --- The discrete nonlinear Schroedinger equation -------------------------------------------------


def test_a_dimer_traps_itself_from_four_on():
    """J. C. Eilbeck, P. S. Lomdahl and A. C. Scott, Physica D 16 (1985) 318; V. M. Kenkre and
    D. K. Campbell, Phys. Rev. B 34 (1986) 4959: from chi = 4 V on, most of the power stays on the
    side where all of it was.
    """

    # fails with 1.01 v, and with half and twice the last terms
    def i_dt(p, u, v):
        return v - p.chi * abs2(u) * u, u - p.chi * abs2(v) * v

    def least_excess(problem, run):
        return (run.linf[0] ** 2 - run.linf[1] ** 2).min()

    model = Model(fields=("u", "v"), parameters={"chi": 1.0}, i_dt=i_dt)
    case = Case(model=model, half_width=0, initial={0: [1, 0]}, end_time=40)
    surveyed = survey(case, {"chi": [3.5, 3.999, 4.001, 4.5]}, keep=[least_excess])
    assert (surveyed["least_excess"].values > 0).tolist() == [False, False, True, True]


def two_sites(eps, second):
    """Return the coupling and the growth rate of a mode on two sites that turns at frequency 1.

    The state that the check finds has the power of the data and its own frequency. Amplitudes and
    time are scaled, which divides coupling and growth by the frequency.
    """
    # fails with + abs2(u) * u, and with 1.02 times either term
    model = Model(
        fields="u", parameters={"eps": eps}, i_dt=lambda p, u: -p.eps * lap(u) - abs2(u) * u
    )
    case = Case(model=model, half_width=20, initial={0: [1], 1: [second]}, end_time=1)
    breather = check_breather(problem_of(case))
    frequency = abs(float(breather["breather_frequency"]))
    return eps / frequency, float(breather["breather_growth"]) / frequency


def test_a_twisted_mode_is_unstable_from_0_146_on():
    """P. G. Kevrekidis, A. R. Bishop and K. O. Rasmussen, Phys. Rev. E 63 (2001) 036603;
    D. E. Pelinovsky, P. G. Kevrekidis and D. J. Frantzeskakis, Physica D 212 (2005) 1."""
    (below, stable), (above, unstable) = (two_sites(eps, -1) for eps in (0.101, 0.102))
    assert 0.145 < below < 0.146 < above < 0.148
    assert stable == 0.0 and unstable > 0.005


def test_a_mode_of_two_sites_in_phase_grows_as_twice_the_root_of_the_coupling():
    """D. E. Pelinovsky, P. G. Kevrekidis and D. J. Frantzeskakis, Physica D 212 (2005) 1."""
    for coupling, limit in ((1e-4, 1e-6), (1e-3, 1e-5), (1e-2, 1e-3)):
        eps, growth = two_sites(coupling, 1)
        assert growth == pytest.approx(2 * np.sqrt(eps), rel=limit)


# --- Waves on chains of particles -----------------------------------------------------------------


def test_an_impact_on_spheres_makes_a_solitary_wave_with_0_682_of_its_velocity():
    """E. J. Hinch and S. Saint-Jean, Proc. R. Soc. A 455 (1999) 3201.

    The speed is within 1 % of that of long waves, (16/25)^(1/5) v^(1/5): V. F. Nesterenko, Dynamics
    of Heterogeneous Materials (Springer 2001).

    The contact opens where spheres part: its force is that of a smooth positive part.
    """

    def force(overlap):
        # fails with the powers 1.4 and 1.6, with twice the force, and with a contact that pulls
        return (0.5 * (overlap + sqrt(overlap * overlap + 1e-8))) ** 1.5

    spheres = rate(lambda p, x, v: (v, force(x.left - x) - force(x - x.right)))
    model = Model(fields=("x", "v"), parameters={}, i_dt=spheres)
    controls = {"name": "dop853", "rtol": 1e-8, "atol": 1e-10}
    case = Case(model=model, half_width=20, initial={-20: [0, 1]}, end_time=36, solver=controls)
    run = simulate(case)
    largest = run["linf"].sel(component="v")
    assert float(largest[0]) == 1
    peak = float(largest.sel(tau=slice(24, 36)).max())
    assert peak == pytest.approx(0.682, abs=0.001)
    power = run["modulus"].sel(component="v", site=slice(-10, None)) ** 2
    places = (power["site"] * power).sum("site") / power.sum("site")
    start, end = (float(places.sel(snapshot=time, method="nearest")) for time in (24, 36))
    assert (end - start) / 12 == pytest.approx(0.64**0.2 * peak**0.2, rel=0.01)


def recurrence(tau, position, momentum):
    """Return when the first of 31 modes has most of its energy again, in its periods, and how much.

    The third number is the least that it had before, the fourth the most in the first period.
    """
    frequency = 2 * np.sin(np.pi / 64)
    energy = 0.5 * (momentum**2 + frequency**2 * position**2) / (8 * frequency**2)
    recurred = np.where(tau > 5000, energy, 0.0).argmax()
    return (
        tau[recurred] * frequency / (2 * np.pi),
        energy[recurred],
        energy[:recurred].min(),
        energy[tau < 64].max(),
    )


def leapfrog(step, alpha, end):
    """Return the recurrence of the scheme of 1955, which is of order two in its step."""
    x, v = np.sin(np.pi * np.arange(33) / 32), np.zeros(33)
    mode, modes = x / 4, np.empty((2, round(end / step)))

    def force(x):
        bond = np.diff(x)
        return np.concatenate([[0.0], np.diff(bond + alpha * bond * bond), [0.0]])

    v += 0.5 * step * force(x)
    for i in range(modes.shape[1]):
        x = x + step * v
        pull = force(x)
        modes[:, i] = mode @ x, mode @ (v + 0.5 * step * pull)
        v += step * pull
    return recurrence(step * np.arange(1, modes.shape[1] + 1), *modes)


def test_fermi_pasta_ulam_and_tsingou_find_their_recurrence():
    """E. Fermi, J. Pasta and S. Ulam, Los Alamos report LA-1940 (1955), Fig. 1, alpha 1/4, N 32.

    The first mode has all of its energy but 3 % again after 157 of its periods, as is quoted since,
    with the report's scheme and its step 1 / sqrt(8). The exact motion is its limit at step zero,
    where it takes 146 periods.
    """

    # fails with alpha / 2, 1.05 alpha and 1.05 (right - left), and with + left * left
    def d2_dt2(p, x):
        right, left = x.right - x, x - x.left
        return right - left + p.alpha * (right * right - left * left)

    def first_mode(p, x, v):
        return {"position": p.mode * x, "momentum": p.mode * v}

    mode = np.sin(np.pi * np.arange(1, 32) / 32)
    parameters = {"alpha": 0.25, "mode": mode / 4}
    model = Model(fields="x", parameters=parameters, d2_dt2=d2_dt2, conserved=first_mode)
    initial = {n: [mode[n + 15]] for n in range(-15, 16)}
    run = simulate(
        Case(model=model, half_width=15, initial=initial, end_time=9500, output_step=0.5)
    )
    periods, energy, least, early = recurrence(run["tau"].values, *run["conserved"].values)
    assert energy > 0.97 and least < 0.1 and early < 1.03
    published, finer = (leapfrog(8**-0.5 / divisor, 0.25, 10200)[0] for divisor in (1, 2))
    assert published == pytest.approx(157, abs=0.5)
    assert periods == pytest.approx(finer - (published - finer) / 3, abs=0.5)


def test_a_soliton_of_toda_is_exact():
    """M. Toda, J. Phys. Soc. Japan 22 (1967) 431: exp(r) - 1 of a bond r is a sech^2 that travels
    at the speed sinh(k) / k."""
    k, half_width, end = 1.0, 30, 20.0
    n = np.arange(-half_width, half_width + 1)

    def soliton(t):
        phase = 2 * (k * (n + 15) - np.sinh(k) * t)
        place = np.logaddexp(0, phase - 2 * k) - np.logaddexp(0, phase)
        slope = 1 / (1 + np.exp(2 * k - phase)) - 1 / (1 + np.exp(-phase))
        return place - 2 * np.sinh(k) * 1j * slope

    # fails with exp(x - x.left) - exp(x.right - x), and with 1.001 times the force
    model = Model(fields="x", parameters={}, d2_dt2=lambda p, x: exp(x.left - x) - exp(x - x.right))
    initial = {int(site): [complex(z)] for site, z in zip(n, soliton(0), strict=True)}
    case = Case(model=model, half_width=half_width, boundary="free", initial=initial, end_time=end)
    value, velocity = simulate(case)["final"].values[:, 0]
    np.testing.assert_allclose(value + 1j * velocity, soliton(end), rtol=0, atol=1e-10)


def test_a_soliton_of_ablowitz_and_ladik_is_exact():
    """M. J. Ablowitz and J. F. Ladik, J. Math. Phys. 17 (1976) 1011: sinh(mu) sech(mu (n - V t)),
    with a phase, moves without a change at V = 2 sinh(mu) sin(kappa) / mu."""
    mu, kappa, half_width, end = 0.8, 0.6, 40, 10.0
    n = np.arange(-half_width, half_width + 1)

    def soliton(t):
        place = n + 8 - 2 * np.sinh(mu) * np.sin(kappa) / mu * t
        phase = kappa * (n + 8) + 2 * np.cosh(mu) * np.cos(kappa) * t
        return np.sinh(mu) / np.cosh(mu * place) * np.exp(1j * phase)

    # fails with 1 - abs2(u), with + in front, and with 1.001 abs2(u)
    model = Model(fields="u", parameters={}, i_dt=lambda p, u: -(1 + abs2(u)) * (u.right + u.left))
    initial = {int(site): [complex(z)] for site, z in zip(n, soliton(0), strict=True)}
    case = Case(model=model, half_width=half_width, initial=initial, end_time=end)
    real, imaginary = simulate(case)["final"].values[:, 0]
    np.testing.assert_allclose(real + 1j * imaginary, soliton(end), rtol=0, atol=1e-9)


# --- Lyapunov exponents ---------------------------------------------------------------------------


def test_lorenz_equations_of_1963_have_the_exponent_0_9056():
    """J. C. Sprott, Chaos and Time-Series Analysis (Oxford 2003): sigma 10, r 28, b 8/3."""

    # fails with r = 24 and 29, and with b = 3
    def lorenz(p, x, y, z):
        return 10 * (y - x), x * (28 - z) - y, x * y - 8 / 3 * z

    model = Model(fields=("x", "y", "z"), parameters={}, i_dt=rate(lorenz))
    start = {"half_width": 0, "initial": {0: [1, 1, 20]}, "output_step": 0.5}
    value, error, chaotic = exponent_of(Case(model=model, end_time=5000, **start))
    assert chaotic and error < 0.01 and abs(value - 0.9056) < 3.5 * error


def test_forty_sites_of_lorenz_1996_have_the_exponent_1_67():
    """A. Karimi and M. R. Paul, Chaos 20 (2010) 043105, of E. N. Lorenz's ring of 1996 at F = 8.

    Field c on site n of the five is site 8 n + c of the ring.
    """

    # fails with F = 7, with + here, and with right + two
    def ring(p, *x):
        after, before = [*x[1:], x[0].right], [x[-1].left, *x[:-1]]
        second = [x[-2].left, *before[:-1]]
        rows = zip(x, after, before, second, strict=True)
        return [(right - two) * left - middle + p.F for middle, right, left, two in rows]

    model = Model(fields=tuple("abcdefgh"), parameters={"F": 8.0}, i_dt=rate(ring))
    initial = {n: [8 + 0.01 * (n == 0), *[8] * 7] for n in range(-2, 3)}
    case = Case(
        model=model,
        half_width=2,
        boundary="periodic",
        initial=initial,
        end_time=2000,
        output_step=0.5,
    )
    value, error, chaotic = exponent_of(case)
    assert chaotic and error < 0.03 and abs(value - 1.67) < 3.5 * error


def stars(energy, end_time):
    """Return a case of Henon and Heiles' star that starts at y = -1/4 with this energy."""

    # fails with - y * y, with + 2 * x * y, and with half of that
    def d2_dt2(p, x, y):
        return -x - 2 * x * y, -y - x * x + y * y

    def conserved(p, x, y, vx, vy):
        return {"E": 0.5 * (vx * vx + vy * vy + x * x + y * y) + x * x * y - y * y * y / 3}

    y = -0.25
    speed = np.sqrt(2 * (energy - y * y / 2 + y**3 / 3))
    model = Model(fields=("x", "y"), parameters={}, d2_dt2=d2_dt2, conserved=conserved)
    initial = {0: [1j * speed, y]}
    return Case(model=model, half_width=0, initial=initial, end_time=end_time, output_step=0.5)


def test_stars_of_henon_and_heiles_are_chaotic_at_energy_one_sixth_and_regular_at_one_twelfth():
    """M. Henon and C. Heiles, Astron. J. 69 (1964) 73, on the energies. The exponent at 1/6 is that
    of 10^6 units of time by a symplectic integrator of order four: 0.1274 +- 0.0012.
    """
    run = simulate(stars(1 / 6, 100))
    np.testing.assert_allclose(run["conserved"][0], 1 / 6, rtol=1e-12)
    value, error, chaotic = exponent_of(stars(1 / 6, 10000))
    assert chaotic and error < 0.006 and abs(value - 0.1274) < 3.5 * error
    value, error, chaotic = exponent_of(stars(1 / 12, 10000))
    assert not chaotic and value < 0.001
