"""The interpolant of order seven of DOP853, between the steps."""

from pendula.compiled import kernel

from .dop853_tableau import D4, D5, D6, D7


@kernel
def combine_all(k, d, h, out):
    """Write h times the combination of stages 1 and 6 to 16 with weights `d` (flat)."""
    k1, k6, k7, k8, k9, k10 = k[0], k[5], k[6], k[7], k[8], k[9]
    k11, k12, k13, k14, k15, k16 = k[10], k[11], k[12], k[13], k[14], k[15]
    for i in range(out.size):
        out[i] = h * (
            d[0] * k1[i] + d[1] * k6[i] + d[2] * k7[i] + d[3] * k8[i]
            + d[4] * k9[i] + d[5] * k10[i] + d[6] * k11[i] + d[7] * k12[i]
            + d[8] * k13[i] + d[9] * k14[i] + d[10] * k15[i] + d[11] * k16[i]
        )  # fmt: skip


@kernel
def prepare_interpolant(y, w, h, k, c):
    """Write the coefficients c[0..6] of the interpolant over the step from `y` to `w`."""
    for row in range(y.shape[0]):
        for j in range(1, y.shape[1] - 1):
            change = w[row, j] - y[row, j]
            c[0, row, j] = change
            c[1, row, j] = h * k[0, row, j] - change
            c[2, row, j] = 2.0 * change - h * (k[12, row, j] + k[0, row, j])
    k_flat = k.reshape(16, -1)
    combine_all(k_flat, D4, h, c[3].reshape(-1))
    combine_all(k_flat, D5, h, c[4].reshape(-1))
    combine_all(k_flat, D6, h, c[5].reshape(-1))
    combine_all(k_flat, D7, h, c[6].reshape(-1))


@kernel
def interpolate(x, y, c, out):
    """Write the interpolant at the fraction `x` of the step into `out`."""
    z = 1.0 - x
    for row in range(y.shape[0]):
        for j in range(1, y.shape[1] - 1):
            inner = c[3, row, j] + x * (c[4, row, j] + z * (c[5, row, j] + x * c[6, row, j]))
            outer = c[0, row, j] + z * (c[1, row, j] + x * (c[2, row, j] + z * inner))
            out[row, j] = y[row, j] + x * outer
