"""The words of RO-Crate and CodeMeta, from installed packages in place of the network."""

import json
from importlib.resources import files

CRATE_1_1 = {"ComputationalWorkflow": "https://bioschemas.org/ComputationalWorkflow"}
"""What the context of RO-Crate 1.1 maps otherwise than the newer one in the package rocrate."""


def crate_context() -> dict:
    """Return the context of RO-Crate."""
    context = json.loads((files("rocrate") / "data/ro-crate.jsonld").read_text("utf-8"))
    return {"@context": {**context["@context"], **CRATE_1_1}}


def codemeta_context() -> dict:
    """Return the context of CodeMeta 3.0."""
    return json.loads((files("codemeta") / "schema/codemeta.jsonld").read_text("utf-8"))


class Answer:
    """What the network would answer to whoever asks for the context of RO-Crate."""

    status_code = 200
    headers = {"Content-Type": "application/ld+json"}

    def json(self) -> dict:
        """Return the document."""
        return crate_context()
