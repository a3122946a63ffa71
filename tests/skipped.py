"""What was skipped, in words for the end of a run."""

from collections.abc import Iterable


def skips_in_words(skipped: Iterable) -> list[str]:
    """Return what was skipped, from the reports of pytest: each reason once, then its tests."""
    tests: dict[str, dict] = {}
    for report in skipped:
        said = report.longrepr[2] if isinstance(report.longrepr, tuple) else str(report.longrepr)
        tests.setdefault(said.removeprefix("Skipped: "), {})[report.nodeid] = None
    lines = []
    for said, names in sorted(tests.items()):
        lines += [f"{len(names)} skipped: {said}", *(f"    {name}" for name in names)]
    return lines
