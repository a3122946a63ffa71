"""Dependencies are used by their front door: no module of numba or Snakemake that is not public.

Such code works until the next release, and then fails in a place that nobody thinks of. Where there
is no public way, one module for each uses a private one, see INSIDE. Ruff finds private names.
"""

import ast

import pytest
from helpers import ROOT

INSIDE = (
    "scripts/pendula/inside_numba.py",
    "tests/test_inside_numba.py",
    "plugins/snakemake-executor-plugin-forked/snakemake_executor_plugin_forked/inside.py",
)
"""What looks inside numba, and inside Snakemake: each says on top what it rests upon, and why."""
PUBLIC = {
    "numba.core": {"cgutils", "errors"},  # of the guide to extending numba, and for its users
    "snakemake": {"api", "utils", "logging", "exceptions", "settings", "script"},
}


def hidden_modules(source: str) -> list[str]:
    """Return the modules that are imported from a package of PUBLIC and are not public."""
    imported = []
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            imported += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and not node.level:
            imported += [f"{node.module}.{alias.name}" for alias in node.names]
    return [
        name
        for name in imported
        for package, public in PUBLIC.items()
        if name.startswith(f"{package}.") and name[len(package) + 1 :].split(".")[0] not in public
    ]


def test_dependencies_are_used_by_their_front_door():
    folders = ("scripts", "workflow", "plugins", "benchmarks", "docs", "tests")
    modules = {path for folder in folders for path in (ROOT / folder).rglob("*.py")}
    modules = {path for path in modules if "build" not in path.parts}  # what pip leaves of a plugin
    looked_at = modules - {ROOT / name for name in INSIDE}
    assert len(looked_at) > 300
    found = {
        path: hidden_modules(path.read_text()) for path in looked_at if "build" not in path.parts
    }
    assert {str(path): names for path, names in found.items() if names} == {}


@pytest.mark.parametrize(
    "code", ["from numba.core.caching import _Cache", "from snakemake.dag import DAG"]
)
def test_a_back_door_is_seen(code):
    assert len(hidden_modules(code)) == 1
