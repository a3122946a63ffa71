"""Check a certificate of a curve, in exact arithmetic and without the code that made it.

    python check_certificate.py certificate.json

says yes or no, by integers, fractions, and roots rounded up. A certificate holds for each step of
length h a polynomial in theta = (tau - start) / h, in units of 2^-bits, rates at equally spaced
theta, and a bound. On a chain of (4) with Dirichlet ends, the l2 distance of the solution of the
printed decimals to the polynomial is at most that bound at the end of the step, which is checked as

    end > exp(x) (start + k (jump + integral of |defect| + h (3 a end + end^2) end / 2)),

k = sqrt(m2 / m1), x the integral of the rate, a the largest modulus; see docs/certified.md. A
certificate of another form than that page describes is rejected with a sentence on the field.
"""

import json
import re
import sys
from fractions import Fraction
from math import isqrt
from operator import mul

WHAT = (
    "i A_n' = epsilon (A_{n+1} - 2 A_n + A_{n-1}) + Omega A_n + gamma (conj B_n - conj A_n) + "
    "|A_n|^2 A_n / 2, the same with A and B exchanged, A = B = 0 beyond the ends"
)
CONSTANTS = ("epsilon", "gamma", "omega")
UNITS = {"steps_per_tau": 2**20, "bits": 1024, "rate_bits": 1024, "bound_bits": 1024}
KEYS = ("what", *CONSTANTS, "initial", *UNITS, "end_time", "steps")
NUMBER = "-?[0-9]{1,99}([.][0-9]{1,99}|/[1-9][0-9]{0,98})?"
TINY = Fraction(1, 2**40)


class RejectedError(ValueError):
    """The certificate proves nothing; the text is the reason."""


# --- The form of a certificate --------------------------------------------------------------------


def require(holds, reason):
    """Raise RejectedError unless something holds."""
    if not holds:
        raise RejectedError(reason)


def keys(value, names, name):
    """Return an object that has all of the keys and no others."""
    require(type(value) is dict, f"{name} must be an object")
    for key in (*names, *value):
        require(key in value, f"{name} lacks {key}")
        require(key in names, f"{name} must not have the key {key!a:.40}")
    return value


def items(value, name, least, most=None):
    """Return a list with an allowed number of items."""
    require(type(value) is list, f"{name} must be a list")
    require(len(value) >= least, f"{name} must have {least} items at least")
    require(most is None or len(value) <= most, f"{name} must have {most} items at most")
    return value


def integer(value, name, least=None, most=None):
    """Return an integer in a range; true, false, 1.0 and texts are none."""
    require(type(value) is int, f"{name} must be an integer")
    require(least is None or value >= least, f"{name} must be at least {least}")
    require(most is None or value <= most, f"{name} must be at most {most}")
    return value


def fraction(value, name):
    """Return the number that a text like -4, 0.1 or 1/10 stands for."""
    right = type(value) is str and re.fullmatch(NUMBER, value)
    require(right, f"{name} must be a decimal or a fraction as a text, like 0.1 or 1/10")
    return Fraction(value)


def states(value, name, sites, number):
    """Return a state in one row: Re A, Im A, Re B, Im B on all sites."""
    rows = items(value, name, 4, 4)
    return [
        number(x, f"{name}[{i}][{j}]")
        for i, row in enumerate(rows)
        for j, x in enumerate(items(row, f"{name}[{i}]", sites, sites))
    ]


def read(path):
    """Return what a file of JSON holds, in which no object has a key twice."""

    def once(pairs):
        require(len(dict(pairs)) == len(pairs), "an object has the same key twice")
        return dict(pairs)

    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file, object_pairs_hook=once)
    except RejectedError:
        raise
    except OSError as error:
        raise RejectedError(f"the file cannot be read: {error.strerror}") from None
    except (ValueError, RecursionError):
        raise RejectedError("the file is not valid JSON in UTF-8") from None


# --- The proof ------------------------------------------------------------------------------------


def root(x):
    """Return a fraction that is no less than the root of x, and hardly more."""
    return Fraction(isqrt(int(x * 4**90) + 1) + 1, 2**90)


def linear(v, eq):
    """Return L v; a state is Re A on all sites, Im A, Re B, Im B."""
    n, out = len(v) // 4, []
    for row in range(4):
        own, other = v[row * n : row * n + n], v[(row + 2) % 4 * n : (row + 2) % 4 * n + n]
        drive = eq["gamma"] if row % 2 == 0 else -eq["gamma"]
        for j in range(n):
            near = (own[j + 1] if j + 1 < n else 0) + (own[j - 1] if j > 0 else 0)
            out.append(eq["epsilon"] * (near - 2 * own[j]) + eq["omega"] * own[j])
            out[-1] += drive * (other[j] - own[j])
    return out


def product(p, q):
    """Return the coefficients of the product of two polynomials."""
    out = [0] * (len(p) + len(q) - 1)
    for i, a in enumerate(p):
        for j, b in enumerate(q):
            out[i + j] += a * b
    return out


def defect(terms, eq, h, unit):
    """Return a bound of the integral over a step of |i p' - F(p)|; terms are (order, place)."""
    order, n = len(terms) - 1, len(terms[0]) // 4
    cubic = [[0] * (4 * n) for _ in range(3 * order + 1)]
    for i in [*range(n), *range(2 * n, 3 * n)]:
        x, y = ([term[j] for term in terms] for j in (i, i + n))
        square = [a + b for a, b in zip(product(x, x), product(y, y), strict=True)]
        for place, part in ((i, x), (i + n, y)):
            for k, value in enumerate(product(square, part)):
                cubic[k][place] = value * unit**3 / 2
    total = 0
    for k, field in enumerate(cubic):
        if k <= order:
            field = [a + b * unit for a, b in zip(field, linear(terms[k], eq), strict=True)]
        missed = [-h * value for value in field]
        for i in range(4 * n if k < order else 0):  # i (x + i y) = -y + i x
            partner, sign = (i + n, -1) if i // n % 2 == 0 else (i - n, 1)
            missed[i] += sign * (k + 1) * terms[k + 1][partner] * unit
        total += root(sum(x * x for x in missed)) / (k + 1)
    return total


def is_rate(rate, state, eq, sign):
    """Return whether rate Q - T is positive definite at a state, by elimination."""
    size, n = len(state), len(state) // 4
    places = range(size)
    s = [linear([int(i == j) for i in places], eq) for j in places]  # symmetric
    v = [[0] * size for _ in places]  # of -i DN(p), (row, column)
    for i in [*range(n), *range(2 * n, 3 * n)]:
        x, y = state[i], state[i + n]
        square, real, imaginary = x * x + y * y, x * x - y * y, 2 * x * y
        v[i][i], v[i][i + n] = imaginary / 2, square - real / 2
        v[i + n][i], v[i + n][i + n] = -square - real / 2, -imaginary / 2
    sv = [[sum(s[i][k] * v[k][j] for k in places if v[k][j]) for j in places] for i in places]
    m = [[sign * (rate * s[i][j] - (sv[i][j] + sv[j][i]) / 2) for j in places] for i in places]
    for i in places:
        if m[i][i] <= 0:
            return False
        for j in range(i + 1, size):
            factor = m[j][i] / m[i][i]
            for k in range(j, size) if factor else ():
                m[k][j] = m[k][j] - factor * m[k][i]
    return True


def growth(terms, rates, eq, h, sign, k):
    """Return exp(x) rounded up, nothing where a rate is none; and a. Terms are fractions."""
    n, last = len(terms[0]) // 4, len(rates) - 1
    places = [*range(n), *range(2 * n, 3 * n)]
    sizes = [[root(t[i] ** 2 + t[i + n] ** 2) for i in places] for t in terms]
    a0, a1, a2 = ([sum(weight(j) * size[i] for j, size in enumerate(sizes)) for i in range(2 * n)]
                  for weight in (lambda j: 1, lambda j: j, lambda j: j * (j - 1)))  # fmt: skip
    largest = max(a0)
    # half of the second derivative of A^2 times (h / last)^2 / 4, and the rounding of the states
    eta = max(b * b + a * c for a, b, c in zip(a0, a1, a2, strict=True)) / last**2 / 4
    eta += 4 * TINY * (largest + TINY)
    factor = Fraction(1)
    for i, rate in enumerate(rates):
        powers = [Fraction(i, last) ** m for m in range(len(terms))]
        state = [sum(map(mul, column, powers)) for column in zip(*terms, strict=True)]
        x = h / last * ((rates[max(i - 1, 0)] + rate) / 2 + Fraction(3, 2) * k * eta)
        rounded = [round(number / TINY) * TINY for number in state]
        if not (rate >= 0 and x <= 1 and is_rate(rate, rounded, eq, sign)):
            return None, largest
        factor *= 1 + x + x**2 / 2 + x**3 / 4 if i > 0 else 1  # no less than exp(x)
    return factor, largest


def check(certificate):
    """Raise RejectedError unless the certificate proves its bounds."""
    keys(certificate, KEYS, "the certificate")
    require(certificate["what"] == WHAT, "what must be equations (4) as this script has them")
    eq = {name: fraction(certificate[name], name) for name in CONSTANTS}
    unit_of = {name: integer(certificate[name], name, 1, most) for name, most in UNITS.items()}
    h = Fraction(1, unit_of.pop("steps_per_tau"))
    unit, rate_unit, bound_unit = (Fraction(1, 2**bits) for bits in unit_of.values())
    sites = len(items(items(certificate["initial"], "initial", 4, 4)[0], "initial[0]", 1))
    state, bound = states(certificate["initial"], "initial", sites, fraction), Fraction(0)
    steps = items(certificate["steps"], "steps", 1)
    end_time = fraction(certificate["end_time"], "end_time")
    require(len(steps) * h == end_time, "end_time must be where the last of the steps ends")
    sign, k = norm(eq)
    for number, step in enumerate(steps):
        name = f"steps[{number}]"
        keys(step, ("terms", "rates", "bound"), name)
        whole = [
            states(term, f"{name}.terms[{i}]", sites, integer)
            for i, term in enumerate(items(step["terms"], f"{name}.terms", 1))
        ]
        rates = [  # they stand at both ends of the step at least
            integer(rate, f"{name}.rates[{i}]", 0) * rate_unit
            for i, rate in enumerate(items(step["rates"], f"{name}.rates", 2))
        ]
        end = integer(step["bound"], f"{name}.bound", 1) * bound_unit
        terms = [[u * unit for u in term] for term in whole]
        jump = root(sum((a - b) ** 2 for a, b in zip(terms[0], state, strict=True)))
        factor, a = growth(terms, rates, eq, h, sign, k)
        require(factor, f"{name}.rates: a rate is too small, or too large for one step")
        off = jump + defect(whole, eq, h, unit) + h * (3 * a * end + end**2) * end / 2
        require(factor * (bound + k * off) < end, f"{name}.bound is too small for this curve")
        bound, state = end, [sum(column) for column in zip(*terms, strict=True)]


def norm(eq):
    """Return the sign of the quadratic part of the energy, and sqrt(m2 / m1) rounded up."""
    low = eq["omega"] - max(0, 4 * eq["epsilon"]) - 2 * abs(eq["gamma"])
    high = eq["omega"] - min(0, 4 * eq["epsilon"]) + 2 * abs(eq["gamma"])
    require(not low <= 0 <= high, "epsilon, gamma and omega: the linear flow keeps no norm")
    small, large = sorted((abs(low), abs(high)))
    return (1 if low > 0 else -1), root(large / small)


def main(paths):
    """Print yes, or no with the reason; return the exit status."""
    try:
        require(len(paths) == 1, "give the path of one certificate")
        check(read(paths[0]))
    except RejectedError as reason:
        print(f"no: {reason}")
        return 1
    print("yes")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
