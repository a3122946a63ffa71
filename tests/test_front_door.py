"""Dependencies are used by their front door: no module of numba or Snakemake that is not public.

Such code works until the next release, and then fails in a place that nobody thinks of. Where there
is no public way, one module for each uses a private one, see INSIDE. Ruff finds private names.
"""

import re

from helpers import ROOT

INSIDE = ("inside_numba.py", "test_inside_numba.py", "inside.py")
"""What looks inside numba, and inside Snakemake: each says on top what it rests upon, and why."""
HIDDEN = re.compile(
    r"^ *(?:from|import) (?:numba\.core(?! import (?:cgutils|errors)\b|\.(?:cgutils|errors)\b)"
    r"|snakemake\.(?!(?:api|utils|logging|exceptions|settings|script)\b))",
    re.MULTILINE,
)


def test_dependencies_are_used_by_their_front_door():
    folders = ("scripts", "workflow", "packages", "benchmarks", "docs", "tests")
    modules = {path for folder in folders for path in (ROOT / folder).rglob("*.py")}
    modules = {path for path in modules if path.name not in INSIDE and "build" not in path.parts}
    assert len(modules) > 300
    assert [str(path) for path in modules if HIDDEN.search(path.read_text())] == []
    assert HIDDEN.search("from numba.core.caching import _Cache")
    assert HIDDEN.search("    from snakemake.dag import DAG")
