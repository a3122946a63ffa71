"""Elementary functions that have the same bits on every machine.

The C library and NumPy compute exp, log, sin, cos and powers with fused operations where the
processor has them. Their last bits therefore differ between processors and versions. Each function
below reduces its argument exactly and sums a short Taylor series, using + - * / and square roots in
a fixed order. IEEE 754 rounds these identically everywhere, NumPy rounds after each operation, and
numba without fastmath fuses none. The reductions follow fdlibm (Sun, 1993).

Functions of `x` take real numbers or arrays of any precision and return doubles of the same shape;
NaN gives NaN. Each docstring states the range of arguments and the error in units in the last place
(ulp). Logarithms return their limits at 0 and infinity. tests/numerics/test_elementary.py measures
the errors and checks a hash of the bits.
"""

from collections.abc import Sequence
from decimal import Decimal, localcontext
from math import factorial

import numpy as np

Real = float | np.ndarray
Complex = complex | np.ndarray

LN2 = 0.6931471803691238, 1.9082149292705877e-10
"""log(2) as a sum of two numbers; the first times an integer below 2^21 is exact."""
HALF_PI = 1.5707963267341256, 6.077100506303966e-11, 2.0222662487959506e-21
"""pi/2 as a sum of three numbers; the first two times an integer below 2^20 are exact."""
SPLITTER = 2.0**27 + 1.0

EXP = [1 / factorial(n) for n in range(2, 15)]
S3, S5, S7, S9, S11, S13, S15, S17 = ((-1) ** n / factorial(2 * n + 1) for n in range(1, 9))
C4, C6, C8, C10, C12, C14, C16, C18 = ((-1) ** n / factorial(2 * n) for n in range(2, 10))
ATANH = [2 / (2 * n + 1) for n in range(1, 13)]


def _horner(coefficients: Sequence[float], x: Real) -> Real:
    """Return the value of a polynomial at x; `coefficients` begin with the constant term."""
    total = coefficients[-1]
    for coefficient in coefficients[-2::-1]:
        total = total * x + coefficient
    return total


def _sum(a: Real, b: Real) -> tuple[Real, Real]:
    """Return the rounded sum a + b and its rounding error (Knuth's two-sum)."""
    total = a + b
    second = total - a
    return total, (a - (total - second)) + (b - second)


def _product(a: Real, b: Real) -> tuple[Real, Real]:
    """Return the rounded product a * b and its rounding error (Dekker, Veltkamp)."""
    (a_high, a_low), (b_high, b_low) = _halves(a), _halves(b)
    total = a * b
    return total, ((a_high * b_high - total) + a_high * b_low + a_low * b_high) + a_low * b_low


def _halves(a: Real) -> tuple[Real, Real]:
    """Return two numbers with the exact sum a, each with half of the digits of a."""
    long = SPLITTER * a
    high = long - (long - a)
    return high, a - high


# --- Exponentials and logarithms ----------------------------------------------------------------


def _reduced_exp(x: Real, low: Real = 0.0) -> tuple[Real, np.ndarray]:
    """Return t and the integer k with exp(x + low) = (1 + t) 2^k and abs(t) < 0.42."""
    x = np.asarray(x, dtype=float).clip(-750.0, 710.0)  # outside, the result is 0 or infinity
    k = np.nan_to_num(np.rint(x * (1.0 / LN2[0])))
    start, correction = x - k * LN2[0], k * LN2[1]
    r = start - correction
    curved = r * r * _horner(EXP, r)
    low = (low + ((start - r) - correction)) * (1.0 + (r + curved))
    return r + (curved + low), k.astype(np.int64)


def exp(x: Real) -> Real:
    """Return e^x, with an error below 1 ulp."""
    t, k = _reduced_exp(x)
    with np.errstate(over="ignore", under="ignore"):
        return np.ldexp(1.0 + t, k)


sqrt = np.sqrt  # IEEE 754 rounds it identically everywhere


def expm1(x: Real) -> Real:
    """Return e^x - 1 for x < 709, with an error below 1.5 ulp."""
    t, k = _reduced_exp(x)
    return (np.ldexp(1.0, k) - 1.0) + np.ldexp(t, k)


def sinh(x: Real) -> Real:
    """Return the hyperbolic sine for abs(x) < 709, with an error below 2 ulp."""
    grown = expm1(np.abs(x))
    return np.copysign(0.5 * (grown + grown / (1.0 + grown)), x)


def cosh(x: Real) -> Real:
    """Return the hyperbolic cosine for abs(x) < 709, with an error below 1.5 ulp."""
    grown = exp(np.abs(x))
    return 0.5 * (grown + 1.0 / grown)


def _reduced_log(x: Real) -> tuple[Real, Real]:
    """Return f and an integer k, as a float, with x = (1 + f) 2^k and 1/2 <= (1 + f)^2 < 2."""
    mantissa, k = np.frexp(x)
    small = mantissa < np.sqrt(0.5)
    return np.where(small, 2.0 * mantissa, mantissa) - 1.0, k - np.where(small, 1.0, 0.0)


def _where_positive(x: Real, value: Real) -> Real:
    """Return `value` where x is positive and finite, elsewhere log(x): -inf, inf or NaN."""
    limit = np.where(x == 0.0, -np.inf, np.where(x == np.inf, np.inf, np.nan))
    return np.where((x > 0.0) & (x < np.inf), value, limit)[()]


def log(x: Real) -> Real:
    """Return the natural logarithm, with an error below 1 ulp; -inf at 0, NaN for x < 0."""
    x = np.asarray(x, dtype=float)
    f, k = _reduced_log(np.where((x > 0.0) & (x < np.inf), x, 1.0))
    s = f / (2.0 + f)
    half = 0.5 * f * f
    series = s * (half + s * s * _horner(ATANH, s * s))
    return _where_positive(x, k * LN2[0] - ((half - (series + k * LN2[1])) - f))


def _log_pair(x: Real) -> tuple[Real, Real]:
    """Return log(x) for finite x > 0 as an unevaluated sum of two numbers, to about 60 bits."""
    f, k = _reduced_log(x)
    sum_high, sum_low = _sum(2.0, f)
    s = f / sum_high
    back, lost = _product(s, sum_high)
    s_low = (((f - back) - lost) - s * sum_low) / sum_high
    high, low = _sum(k * LN2[0], 2.0 * s)
    low = low + (2.0 * s_low + s * s * s * _horner(ATANH, s * s) + k * LN2[1])
    return _sum(high, low)


def power(x: Real, y: Real) -> Real:
    """Return x^y for 0 < x < inf, with an error below 1 ulp if the result is a normal double."""
    high, low = _log_pair(np.asarray(x, dtype=float))
    product_high, product_low = _product(np.asarray(y, dtype=float), high)
    t, k = _reduced_exp(product_high, product_low + y * low)
    with np.errstate(over="ignore", under="ignore"):
        return np.ldexp(1.0 + t, k)


def geometric(start: float, stop: float, count: int) -> np.ndarray:
    """Return `count` >= 2 numbers in geometric progression from `start` to `stop`, both positive.

    Each number is the exact value rounded to a double, computed with 40 decimal digits.
    """
    with localcontext() as context:
        context.prec = 40
        first = Decimal(float(start))
        ratio = Decimal(float(stop)) / first
        steps = [Decimal(i) / (count - 1) for i in range(1, count - 1)]
        return np.array([start, *(float(first * ratio**step) for step in steps), stop], float)


def fifth_root(x: float) -> float:
    """Return x^(1/5) of one number x >= 0, with an error below 1 ulp; 0, inf and NaN are unchanged.

    Kernels compile this function. It branches on x and therefore takes no arrays.
    """
    if not 0.0 < x < np.inf:
        return x
    scale = 1.0
    while x >= 32.0:
        x, scale = x * 0.03125, scale * 2.0
    while x < 1.0:
        x, scale = x * 32.0, scale * 0.5
    root = 0.916 + x * (0.1145 + x * (0.0000868 * x - 0.00525))  # within 3 %
    for _ in range(2):  # Halley's method: a relative error e becomes 2 e^3
        fifth = root * root * root * root * root
        root *= (2.0 * fifth + 3.0 * x) / (3.0 * fifth + 2.0 * x)
    root += 0.2 * (x / (root * root * root * root) - root)  # Newton's method, for the last bits
    return root * scale


# --- Sines and cosines --------------------------------------------------------------------------


def sine_less_angle(x: Real, low: Real = 0.0) -> Real:
    """Return sin(x + low) - x for abs(x) <= 1 and `low` below an ulp of x; kernels use it too."""
    z = x * x
    far = S9 + z * (S11 + z * (S13 + z * (S15 + S17 * z)))
    return x * z * (S3 + z * (S5 + z * (S7 + z * far))) + low * (1.0 - 0.5 * z)


def sine_near_zero(x: Real, low: Real = 0.0) -> Real:
    """Return sin(x + low) for abs(x) <= 1 and `low` below an ulp of x."""
    return x + sine_less_angle(x, low)


def cosine_near_zero(x: Real, low: Real = 0.0) -> Real:
    """Return cos(x + low) for abs(x) <= 1 and `low` below an ulp of x; kernels use it too."""
    z = x * x
    far = C10 + z * (C12 + z * (C14 + z * (C16 + C18 * z)))
    curved = z * z * (C4 + z * (C6 + z * (C8 + z * far)))
    half = 0.5 * z
    rounded = 1.0 - half
    return rounded + (((1.0 - rounded) - half) + (curved - x * low))


def sine_and_cosine(x: Real) -> tuple[Real, Real]:
    """Return sin(x) and cos(x) for abs(x) < 1.6e6, else NaN, with errors below 1 ulp."""
    x = np.asarray(x, dtype=float)
    x = np.where(np.abs(x) < 1.6e6, x, np.nan)
    k = np.rint(x * (1.0 / HALF_PI[0]))
    r, first = _sum(x - k * HALF_PI[0], -(k * HALF_PI[1]))
    r, second = _sum(r, first - k * HALF_PI[2])
    sine, cosine = sine_near_zero(r, second), cosine_near_zero(r, second)
    quarter = k - 4.0 * np.floor(0.25 * k)
    odd = (quarter == 1.0) | (quarter == 3.0)
    s, c = np.where(odd, cosine, sine), np.where(odd, sine, cosine)
    return (
        np.where(quarter >= 2.0, -s, s)[()],
        np.where((quarter == 1.0) | (quarter == 2.0), -c, c)[()],
    )


def sin(x: Real) -> Real:
    """Return the sine for abs(x) < 1.6e6, else NaN, with an error below 1 ulp."""
    return sine_and_cosine(x)[0]


def cos(x: Real) -> Real:
    """Return the cosine for abs(x) < 1.6e6, else NaN, with an error below 1 ulp."""
    return sine_and_cosine(x)[1]


# --- Complex numbers ----------------------------------------------------------------------------


def complex_of(real: Real, imaginary: Real) -> Complex:
    """Return real + i imaginary, without multiplying by i, which some processors would fuse."""
    pair = np.empty(np.broadcast_shapes(np.shape(real), np.shape(imaginary)), complex)
    pair.real, pair.imag = real, imaginary
    return pair[()]


def product(a: Complex, b: Complex) -> Complex:
    """Return the product a b of complex numbers or arrays, without fused operations."""
    a, b = np.asarray(a), np.asarray(b)
    return complex_of(a.real * b.real - a.imag * b.imag, a.real * b.imag + a.imag * b.real)


def square_modulus(z: Complex) -> Real:
    """Return abs(z)^2."""
    z = np.asarray(z)
    return z.real * z.real + z.imag * z.imag


def quotient(a: Complex, b: Complex) -> Complex:
    """Return the quotient a / b of complex numbers or arrays, as a conj(b) / abs(b)^2."""
    return product(a, np.conj(b)) / square_modulus(b)


def square_root(z: Complex) -> Complex:
    """Return the root of z that has a nonnegative real part; it is inaccurate near z = 0."""
    z = np.asarray(z)
    size = modulus(z)
    small = np.sqrt(0.5 * (size + np.abs(z.real)))
    other_part = 0.5 * np.abs(z.imag) / np.where(small > 0.0, small, 1.0)
    ahead = z.real >= 0.0
    imaginary = np.copysign(np.where(ahead, other_part, small), z.imag)
    return complex_of(np.where(ahead, small, other_part), imaginary)


def modulus(z: Complex) -> Real:
    """Return abs(z), with an error of 1 ulp, and without overflow of the squares."""
    z = np.asarray(z)
    largest = np.maximum(np.abs(z.real), np.abs(z.imag))
    k = np.frexp(np.where(np.isfinite(largest), largest, 1.0))[1]
    real, imaginary = np.ldexp(z.real, -k), np.ldexp(z.imag, -k)
    return np.ldexp(np.sqrt(real * real + imaginary * imaginary), k)


def turn(angle: Real) -> Complex:
    """Return exp(i angle) for abs(angle) < 1.6e6; else NaN."""
    sine, cosine = sine_and_cosine(angle)
    return complex_of(cosine, sine)
