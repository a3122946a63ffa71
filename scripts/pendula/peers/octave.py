"""GNU Octave's ode45, run as a program of its own that reports its own time."""

import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from .problem import Peer, Problem, Solve, check

PROGRAM = """1;  % a script, not a function file
function slope = rates(tau, u, n, epsilon, gamma_, omega)
  z = reshape(u, n, 2);
  padded = [0, 0; z; 0, 0];
  coupling = epsilon * (padded(3:end, :) - 2 * z + padded(1:end-2, :));
  drive = gamma_ * (conj(fliplr(z)) - conj(z));
  slope = -1i * (coupling + omega * z + drive + 0.5 * abs(z) .^ 2 .* z)(:);
end
u = {start};
f = @(tau, u) rates(tau, u, {n}, {epsilon!r}, {gamma!r}, {omega!r});
options = odeset("RelTol", {rtol!r}, "AbsTol", {atol!r}, "Refine", 1);
[tau, y] = ode45(f, [0, {short!r}], u, options);
tic;
[tau, y] = ode45(f, [0, {end_time!r}], u, options);
seconds = toc;
printf("%.17g\\n", seconds, [real(y(end, :)); imag(y(end, :))]);
"""


def why_absent() -> str | None:
    """Return what is missing."""
    return None if shutil.which("octave-cli") else "octave-cli is not on the PATH"


def prepare(problem: Problem) -> Solve:
    """Return ode45 with the absolute tolerance rtol / 100, as in the paper's pair."""
    check(problem)
    epsilon, gamma, omega = map(float, problem.constants)
    z, end_time = problem.amplitudes, float(problem.end_time)
    parts = ", ".join(f"{complex(u).real!r} + {complex(u).imag!r}i" for u in z.ravel())

    def solve(rtol):
        text = PROGRAM.format(
            start=f"complex([{parts}].')",
            n=z.shape[1],
            epsilon=epsilon,
            gamma=gamma,
            omega=omega,
            rtol=float(rtol),
            atol=0.01 * rtol,
            short=0.01 * end_time,
            end_time=end_time,
        )
        seconds, *values = run(text)
        return np.array(values).view(complex).reshape(z.shape), seconds

    return solve


def run(program: str) -> list[float]:
    """Return the numbers that a program of Octave prints."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "integrate.m"
        path.write_text(program)
        done = subprocess.run(
            ["octave-cli", "--no-init-file", "--quiet", path.name],
            cwd=folder,
            capture_output=True,
            text=True,
        )
    if done.returncode:
        raise RuntimeError(f"Octave failed: {done.stderr.strip()}")
    return [float(word) for word in done.stdout.split()]


ODE45 = Peer("Octave ode45", why_absent, prepare)
