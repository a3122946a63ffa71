"""Make the certificate of a short case, for those who check it by other means."""

import json
from typing import Any

from pendula.datasets import complete_or_absent
from pendula.problem import Problem
from pendula.studies.certified.certificate import make_certificate


def write_certificate(certificate: str, problem: dict[str, Any]) -> None:
    """Write the certificate as JSON, one step a line."""
    made = make_certificate(Problem.of(problem))
    steps = ",\n".join(json.dumps(step) for step in made.pop("steps"))
    about = json.dumps(made, indent=1).removesuffix("\n}")
    with complete_or_absent(certificate) as partial:
        partial.write_text(f'{about},\n "steps": [\n{steps}\n]}}\n', encoding="utf-8")


if __name__ == "__main__":
    from job import run

    run(write_certificate, snakemake)  # noqa: F821
