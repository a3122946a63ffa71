"""The stages of DOP853, written out: each one is a single pass over the state."""

from pendula.compiled import kernel

from .dop853_tableau import A2, A3, A4, A5, A6, A7, A8, A9, A10, A11, A12, A13, A14, A15, A16


@kernel
def combine(stage, y, h, k, w):
    """Write the argument of stage 2 to 16 into `w`; stage 13 is the solution itself.

    `y` and `w` are flat, `k[stage - 1]` holds the slopes found so far.
    """
    k1, k2, k3, k4, k5, k6, k7, k8 = k[0], k[1], k[2], k[3], k[4], k[5], k[6], k[7]
    k9, k10, k11, k12, k13, k14, k15 = k[8], k[9], k[10], k[11], k[12], k[13], k[14]
    size = y.size
    if stage == 2:
        for i in range(size):
            w[i] = y[i] + h * (A2[0] * k1[i])
    elif stage == 3:
        for i in range(size):
            w[i] = y[i] + h * (A3[0] * k1[i] + A3[1] * k2[i])
    elif stage == 4:
        for i in range(size):
            w[i] = y[i] + h * (A4[0] * k1[i] + A4[1] * k3[i])
    elif stage == 5:
        for i in range(size):
            w[i] = y[i] + h * (A5[0] * k1[i] + A5[1] * k3[i] + A5[2] * k4[i])
    elif stage == 6:
        for i in range(size):
            w[i] = y[i] + h * (A6[0] * k1[i] + A6[1] * k4[i] + A6[2] * k5[i])
    elif stage == 7:
        for i in range(size):
            w[i] = y[i] + h * (A7[0] * k1[i] + A7[1] * k4[i] + A7[2] * k5[i] + A7[3] * k6[i])
    elif stage == 8:
        for i in range(size):
            w[i] = y[i] + h * (
                A8[0] * k1[i] + A8[1] * k4[i] + A8[2] * k5[i] + A8[3] * k6[i]
                + A8[4] * k7[i]
            )  # fmt: skip
    elif stage == 9:
        for i in range(size):
            w[i] = y[i] + h * (
                A9[0] * k1[i] + A9[1] * k4[i] + A9[2] * k5[i] + A9[3] * k6[i]
                + A9[4] * k7[i] + A9[5] * k8[i]
            )  # fmt: skip
    elif stage == 10:
        for i in range(size):
            w[i] = y[i] + h * (
                A10[0] * k1[i] + A10[1] * k4[i] + A10[2] * k5[i] + A10[3] * k6[i]
                + A10[4] * k7[i] + A10[5] * k8[i] + A10[6] * k9[i]
            )  # fmt: skip
    elif stage == 11:
        for i in range(size):
            w[i] = y[i] + h * (
                A11[0] * k1[i] + A11[1] * k4[i] + A11[2] * k5[i] + A11[3] * k6[i]
                + A11[4] * k7[i] + A11[5] * k8[i] + A11[6] * k9[i] + A11[7] * k10[i]
            )  # fmt: skip
    elif stage == 12:
        for i in range(size):
            w[i] = y[i] + h * (
                A12[0] * k1[i] + A12[1] * k4[i] + A12[2] * k5[i] + A12[3] * k6[i]
                + A12[4] * k7[i] + A12[5] * k8[i] + A12[6] * k9[i] + A12[7] * k10[i]
                + A12[8] * k11[i]
            )  # fmt: skip
    elif stage == 13:
        for i in range(size):
            w[i] = y[i] + h * (
                A13[0] * k1[i] + A13[1] * k6[i] + A13[2] * k7[i] + A13[3] * k8[i]
                + A13[4] * k9[i] + A13[5] * k10[i] + A13[6] * k11[i] + A13[7] * k12[i]
            )  # fmt: skip
    elif stage == 14:
        for i in range(size):
            w[i] = y[i] + h * (
                A14[0] * k1[i] + A14[1] * k7[i] + A14[2] * k8[i] + A14[3] * k9[i]
                + A14[4] * k10[i] + A14[5] * k11[i] + A14[6] * k12[i] + A14[7] * k13[i]
            )  # fmt: skip
    elif stage == 15:
        for i in range(size):
            w[i] = y[i] + h * (
                A15[0] * k1[i] + A15[1] * k6[i] + A15[2] * k7[i] + A15[3] * k8[i]
                + A15[4] * k11[i] + A15[5] * k12[i] + A15[6] * k13[i] + A15[7] * k14[i]
            )  # fmt: skip
    elif stage == 16:
        for i in range(size):
            w[i] = y[i] + h * (
                A16[0] * k1[i] + A16[1] * k6[i] + A16[2] * k7[i] + A16[3] * k8[i]
                + A16[4] * k9[i] + A16[5] * k13[i] + A16[6] * k14[i] + A16[7] * k15[i]
            )  # fmt: skip
