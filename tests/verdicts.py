"""Compare the verdicts of two runs: python tests/verdicts.py <claims.json> <claims.json>."""

import json
import sys
from pathlib import Path


def verdicts(path: str) -> dict[str, str]:
    """Return the verdict of each claim, and whether each of its controls came out as it must."""
    found = {}
    for row in json.loads(Path(path).read_text())["rows"]:
        found[row["name"]] = row["verdict"]
        for control in row["controls"]:
            found[f"{row['name']}, {control['fed']}"] = f"passes: {control['passes']}"
    return found


def compare(kept: dict[str, str], found: dict[str, str]) -> list[str]:
    """Return what has turned, in words."""
    names = [name for name in kept | found if kept.get(name) != found.get(name)]
    return [f"{name}: {kept.get(name)} has become {found.get(name)}" for name in names]


if __name__ == "__main__":
    sys.exit("\n".join(compare(*map(verdicts, sys.argv[1:]))) or None)
