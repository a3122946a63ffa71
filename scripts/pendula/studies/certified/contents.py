"""The dataset of a curve with its proven error bound."""

from latticode.datasets.netcdf import Variable
from latticode.datasets.stated import describe_run
from latticode.datasets.trajectories import Contents
from replication.logs import Progress

from pendula.many_cases import COMPONENTS
from pendula.problem import PaperProblem

from . import frames


def certify_curve(
    name: str, problem: PaperProblem, bits: int, order: int, outputs_per_frame: int
) -> Contents:
    """Return the dataset of a curve: its norms, and a proven bound of their errors."""
    proof = {"bits": bits, "order": order, "outputs_per_frame": outputs_per_frame}
    curve = frames.certify(problem, **proof, progress=Progress(f"outputs of {name}"))
    norms, of_tau = ("component", "tau"), ("tau",)
    variables = {
        "tau": Variable(of_tau, curve.tau),
        "component": COMPONENTS,
        "linf": Variable(norms, curve.linf),
        "l2": Variable(norms, curve.l2),
        "bound": Variable(
            of_tau,
            curve.bound,
            "bound, as proved, of the l2 distance to the true state, and so of each norm's error",
        ),
    }
    attributes = {
        "title": f"Norms of {name} against time, with a proven bound of their distance to the "
        "true ones",
        **describe_run(name, problem, {"name": "polynomials of integers", **proof}),
        "parameters_mean": "the printed decimals",
    }
    return variables, attributes
