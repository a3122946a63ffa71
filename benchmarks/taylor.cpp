// The Taylor method of integrators/taylor.py and models/amplitudes_series.py on half a chain, by hand.
//
// The sites 0..M are divided into blocks of LANES sites (4 or 8, by -DLANES). The numbers of a block
// are contiguous, so the compiler knows their offsets. Orders are computed in pairs: one pass over a
// block sums in registers the Cauchy products of an even order, and those of the next order without
// the terms that contain its own coefficients. Each loaded number is thus used twice.

#include <cmath>
#include <utility>
#include <vector>

constexpr int ORDER = 16;
constexpr double SMALLEST_PART = 1e-14;
typedef double Vec __attribute__((vector_size(8 * LANES)));
typedef long long Mask __attribute__((vector_size(8 * LANES)));
constexpr Vec ZERO = {};
#if LANES == 8
constexpr Mask TO_RIGHT = {1, 2, 3, 4, 5, 6, 7, 8}, TO_LEFT = {7, 8, 9, 10, 11, 12, 13, 14};
constexpr Mask MIRRORED = {1, 0, 1, 2, 3, 4, 5, 6};
#else
constexpr Mask TO_RIGHT = {1, 2, 3, 4}, TO_LEFT = {3, 4, 5, 6}, MIRRORED = {1, 0, 1, 2};
#endif

struct Block {
    Vec c[ORDER + 2][4];        // coefficients of Re A, Im A, Re B, Im B; the last is work space
    Vec density[ORDER + 1][2];  // of |A|^2, |B|^2
};

struct Chain {
    double epsilon, gamma, omega;
    std::vector<Block> blocks;  // the last one is at rest, beyond the end of the chain
    Mask inside;                // the lanes of the last block that are sites

    const Block *first() const { return blocks.data(); }
    const Block *end() const { return blocks.data() + blocks.size() - 1; }
    Block *begin() { return blocks.data(); }
};

// If compiled with -DREST, replace numbers below `level` by zero, because subnormal numbers are slow
// (see integrators/rest.py).
static inline Vec without_tiny(Vec value, double level) {
#ifdef REST
    return (Vec)((Mask)value & ~((value < level) & (value > -level)));
#else
    return value;
#endif
}

// Load into a register once; otherwise GCC loads again for each product.
static inline Vec load(const Vec &source) {
    Vec value = source;
    asm("" : "+v"(value));
    return value;
}

// Return a coefficient of order k + 1 from row `of` at order k and the cubic term, times `factor`.
static inline Vec next(const Chain &s, const Block *b, int k, int of, double drive, double factor,
                       Vec cubic) {
    const double aside = factor * s.epsilon, coupling = factor * drive, half = 0.5 * factor;
    const double own = factor * (s.omega - 2.0 * s.epsilon - drive);
    Vec here = load(b->c[k][of]), partner = b->c[k][(of + 2) % 4];
    Vec right = __builtin_shuffle(here, b[1].c[k][of], TO_RIGHT);
    Vec left = b == s.first() ? __builtin_shuffle(here, MIRRORED)
                              : __builtin_shuffle(b[-1].c[k][of], here, TO_LEFT);
    Vec result = (aside * (right + left) + own * here) + (coupling * partner + half * cubic);
    return b + 1 == s.end() ? (Vec)((Mask)result & s.inside) : result;
}

// Write order k + 1 of the rows re and re + 1, given the cubic terms of order k.
static inline void extend(const Chain &s, Block *b, int k, int re, Vec cubic_re, Vec cubic_im) {
    const double share = 1.0 / (k + 1);
    b->c[k + 1][re] = next(s, b, k, re + 1, -s.gamma, share, cubic_im);
    b->c[k + 1][re + 1] = next(s, b, k, re, s.gamma, -share, cubic_re);
}

// Compute an even order K. The rows of order K + 2 store partial sums of the cubic terms of K + 1.
template <int K> static inline void even_order(Chain &s, Block *b, int re) {
    auto x = [=](int k) -> Vec & { return b->c[k][re]; };
    auto y = [=](int k) -> Vec & { return b->c[k][re + 1]; };
    auto density = [=](int k) -> Vec & { return b->density[k][re / 2]; };
    // independent sums, because the processor can start an addition before the last one is complete
    Vec sum_x = 0.5 * x(K / 2) * x(K / 2), sum_y = 0.5 * y(K / 2) * y(K / 2);
    Vec later_x = ZERO, later_y = ZERO, low_x = load(x(0)), low_y = load(y(0));
#pragma GCC unroll 16
    for (int j = 1; j <= K / 2; j++) {
        Vec high_x = load(x(K + 1 - j)), high_y = load(y(K + 1 - j));
        sum_x += low_x * high_x;
        sum_y += low_y * high_y;
        low_x = load(x(j));
        low_y = load(y(j));
        later_x += low_x * high_x;
        later_y += low_y * high_y;
    }
    Vec sum = sum_x + sum_y, later = later_x + later_y;
    density(K) = without_tiny(sum + sum, 1e-150);
    density(K + 1) = later + later;
    Vec now_x = ZERO, now_y = ZERO, next_x = ZERO, next_y = ZERO, here = load(density(0));
#pragma GCC unroll 16
    for (int j = 0; j < K; j++) {
        Vec other_x = load(x(K - j)), other_y = load(y(K - j));
        now_x += here * other_x;
        now_y += here * other_y;
        here = load(density(j + 1));
        next_x += here * other_x;
        next_y += here * other_y;
    }
    b->c[K + 2][re] = next_x;
    b->c[K + 2][re + 1] = next_y;
    extend(s, b, K, re, now_x + here * x(0), now_y + here * y(0));
}

// Compute an odd order k: add the terms that contain its own coefficients.
static inline void odd_order(Chain &s, Block *b, int k, int re) {
    Vec x0 = b->c[0][re], y0 = b->c[0][re + 1], x = b->c[k][re], y = b->c[k][re + 1];
    Vec half = x0 * x + y0 * y, density = without_tiny(b->density[k][re / 2] + (half + half), 1e-150);
    Vec first = b->density[0][re / 2];
    b->density[k][re / 2] = density;
    Vec cubic_x = b->c[k + 1][re] + (density * x0 + first * x);
    Vec cubic_y = b->c[k + 1][re + 1] + (density * y0 + first * y);
    extend(s, b, k, re, cubic_x, cubic_y);
}

template <int K> static void two_orders(Chain &s) {
    for (Block *b = s.begin(); b < s.end(); b++) {
        even_order<K>(s, b, 0);
        even_order<K>(s, b, 2);
    }
    for (Block *b = s.begin(); b < s.end(); b++) {
        odd_order(s, b, K + 1, 0);
        odd_order(s, b, K + 1, 2);
    }
}

template <int... PAIR> static void expand(Chain &s, std::integer_sequence<int, PAIR...>) {
    (two_orders<2 * PAIR>(s), ...);
}

// Return the largest modulus of a coefficient of order k.
static double size(Chain &s, int k) {
    double largest = 0.0;
    Vec top = ZERO, sum = ZERO;
    for (Block *b = s.begin(); b < s.end(); b++)
        for (int re = 0; re < 4; re += 2) {
            Vec square = b->c[k][re] * b->c[k][re] + b->c[k][re + 1] * b->c[k][re + 1];
            top = square > top ? square : top;
            sum += square;
        }
    for (int lane = 0; lane < LANES; lane++) {
        if (std::isnan(sum[lane])) return NAN;
        largest = std::fmax(largest, top[lane]);
    }
    return std::sqrt(largest);
}

// Replace order 0 by the sum of the series after a step h.
static void advance(Chain &s, double h) {
    const double h2 = h * h, h3 = h2 * h, h4 = h2 * h2;
    for (Block *b = s.begin(); b < s.end(); b++)
        for (int row = 0; row < 4; row++) {
            auto c = [=](int k) { return b->c[k][row]; };
            Vec total = c(ORDER);
            for (int k = ORDER; k >= 4; k -= 4)
                total = total * h4 + ((c(k - 1) * h3 + c(k - 2) * h2) + (c(k - 3) * h + c(k - 4)));
            b->c[0][row] = without_tiny(total, 1e-130);
        }
}

// Return the step that the last two orders allow, NaN if they are not finite.
static double step(Chain &s, double rtol, double atol) {
    expand(s, std::make_integer_sequence<int, ORDER / 2>());
    const double allowed = atol + rtol * size(s, 0);
    const double last = size(s, ORDER), before = size(s, ORDER - 1);
    if (!(last + before < INFINITY)) return NAN;
    return std::fmin(std::pow(allowed / last, 1.0 / ORDER),
                     std::pow(allowed / before, 1.0 / (ORDER - 1)));
}

// Integrate the rows of y (4, n) from 0 to `end`; return the number of steps, or -1.
extern "C" long solve(double epsilon, double gamma, double omega, long n, double *y, double end,
                      double rtol, double atol) {
    const long blocks = (n + LANES - 1) / LANES;
    Chain s = {epsilon, gamma, omega, std::vector<Block>(blocks + 1), {}};
    for (long lane = 0; lane < LANES; lane++)
        s.inside[lane] = (blocks - 1) * LANES + lane < n ? -1 : 0;
    for (long i = 0; i < 4 * n; i++)
        s.blocks[i % n / LANES].c[0][i / n][i % n % LANES] = y[i];
    double t = 0.0;
    long steps = 0;
    while (t < end) {
        double h = step(s, rtol, atol);
        if (!(h > SMALLEST_PART * end)) return -1;
        steps++;
        if (h * (1.0 + 1e-9) >= end - t) h = end - t;
        advance(s, h);
        t = h == end - t ? end : t + h;
    }
    for (long i = 0; i < 4 * n; i++)
        y[i] = s.blocks[i % n / LANES].c[0][i / n][i % n % LANES];
    return steps;
}
