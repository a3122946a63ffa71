"""Check a certificate of a curve, in exact arithmetic and without the code that made it.

    python check_certificate.py certificate.json

says yes or no, by integers, fractions, and roots rounded up. A certificate holds for each step of
length h a polynomial in theta = (tau - start) / h, in units of 2^-bits, rates at equally spaced
theta, and a bound. On a chain of (4) with Dirichlet ends, the l2 distance of the solution of the
printed decimals to the polynomial is at most that bound at the end of the step, which is checked as

    end > exp(x) (start + k (jump + integral of |defect| + h (3 a end + end^2) end / 2)),

k = sqrt(m2 / m1), x the integral of the rate, a the largest modulus; see docs/certified.md.
"""

import json
import sys
from fractions import Fraction
from math import isqrt
from operator import mul

TINY = Fraction(1, 2**40)


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
    """Return why the certificate proves nothing; an empty text where it holds."""
    eq = {name: Fraction(certificate[name]) for name in ("epsilon", "gamma", "omega")}
    h, unit = Fraction(1, certificate["steps_per_tau"]), Fraction(1, 2 ** certificate["bits"])
    low = eq["omega"] - max(0, 4 * eq["epsilon"]) - 2 * abs(eq["gamma"])
    high = eq["omega"] - min(0, 4 * eq["epsilon"]) + 2 * abs(eq["gamma"])
    end = len(certificate["steps"]) * h
    if low <= 0 <= high or end <= 0 or end != Fraction(certificate["end_time"]):
        return "the linear flow keeps no norm, or the steps do not lead to the end"
    k = root(max(abs(low), abs(high)) / min(abs(low), abs(high)))
    state, bound = [Fraction(x) for row in certificate["initial"] for x in row], Fraction(0)
    for number, step in enumerate(certificate["steps"]):
        whole = [[int(u) for row in term for u in row] for term in step["terms"]]
        terms = [[u * unit for u in term] for term in whole]
        jump = root(sum((a - b) ** 2 for a, b in zip(terms[0], state, strict=True)))
        rates = [Fraction(rate, 2 ** certificate["rate_bits"]) for rate in step["rates"]]
        factor, a = growth(terms, rates, eq, h, 1 if low > 0 else -1, k)
        if factor is None or len(rates) < 2:  # they stand at both ends of the step at least
            return f"step {number}: a rate is too small, or too large for one step"
        end = Fraction(step["bound"], 2 ** certificate["bound_bits"])
        off = jump + defect(whole, eq, h, unit) + h * (3 * a * end + end**2) * end / 2
        if not factor * (bound + k * off) < end:
            return f"step {number}: the bound is too small"
        bound, state = end, [sum(column) for column in zip(*terms, strict=True)]
    return ""


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as file:
        reason = check(json.load(file))
    print(f"no: {reason}" if reason else "yes")
    sys.exit(bool(reason))
