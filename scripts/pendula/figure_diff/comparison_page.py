"""What a comparison writes: its verdict, and a page of reference, new image and difference."""

import json
from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from pendula.datasets.netcdf import readable
from pendula.report import page
from pendula.report.page import address_of

from . import IDENTICAL, STATUSES, Finding, Verdict
from .compare_images import DamagedImageError, read
from .tolerances import NEEDS_A_REASON, Allowance, allowances, read_tolerances


def dump(verdict: Verdict, path: str | Path) -> None:
    """Write the verdict to `path` as JSON."""
    findings = [asdict(finding) for finding in verdict.findings]
    text = json.dumps({"judged": verdict.judged, "findings": findings}, indent=1)
    Path(path).write_text(text + "\n", encoding="utf-8")


def load(path: str | Path) -> Verdict:
    """Return the verdict that `dump` wrote to `path`."""
    with readable(path):
        content = json.loads(Path(path).read_text(encoding="utf-8"))
        return Verdict(content["judged"], [Finding(**entry) for entry in content["findings"]])


def render(verdict: Verdict, made: Path, folder: Path) -> str:
    """Return the page; images are read from below `made` and from the baseline's folder."""
    findings = verdict.findings
    return page.render(
        "comparison_page.html.j2",
        Path(__file__).parent,
        counts=Counter(finding.status for finding in findings),
        faults=sum(finding.is_fault for finding in findings),
        statuses=STATUSES,
        note=verdict.judged,
        allowances=_allowed(folder),
        share=f"{NEEDS_A_REASON:.0%}",
        sections=[_section(status, findings, made, folder) for status in STATUSES],
    )


def _allowed(folder: Path) -> list[dict[str, str]]:
    """Return for which curves more than NEEDS_A_REASON is allowed, how much, and why."""
    large = [each for each in allowances(*read_tolerances(folder)) if each.needs_a_reason]
    of_rule = {each.rule.name: each.rule for each in large}
    return [
        {
            "curves": " ".join(rule.labels),
            "allowed": ", ".join(map(_in_words, (each for each in large if each.rule == rule))),
            "reason": f"{rule.reason} {rule.wide}".strip(),
        }
        for rule in of_rule.values()
    ]


def _in_words(allowance: Allowance) -> str:
    usual, most = map(_share, (allowance.median, allowance.largest))
    return f"{allowance.statistic} {usual} (at most {most})"


def _share(fraction: float) -> str:
    return f"{fraction:.0%}" if fraction < 10 else f"a factor of {1 + fraction:.1g}"


def _section(status: str, findings: Sequence[Finding], made: Path, folder: Path) -> dict[str, Any]:
    """Return all findings of one status, and what is shown of those on images."""
    mine = [finding for finding in findings if finding.status == status]
    # Pictures that are as they were are named only: showing them took half of the time.
    drawn = [] if status == IDENTICAL else mine
    images = [finding for finding in drawn if finding.name.endswith(".png")]
    return {
        "status": status,
        "files": [finding for finding in mine if finding not in images],
        "images": [(finding, _shown(finding.name, made, folder)) for finding in images],
        "is_open": status != IDENTICAL,
    }


def _shown(name: str, made: Path, folder: Path) -> list[dict[str, str]]:
    """Return addresses and captions of three images; an absent image has an empty address."""
    new, reference = made / name, folder / name
    addresses = {
        "reference": _whole(reference),
        "new": _whole(new),
        "difference (grey: same, red: gone, blue: new)": _difference(reference, new),
    }
    return [{"address": address, "caption": caption} for caption, address in addresses.items()]


def _whole(path: Path) -> str:
    return address_of(path.read_bytes()) if _colours(path) is not None else ""


def _difference(reference: Path, new: Path) -> str:
    """Return at half the size what both share in grey, what is gone in red, what is new in blue."""
    was, now = _colours(reference), _colours(new)
    if was is None or now is None or was.shape != now.shape:
        return ""
    was, now = (np.asarray(Image.fromarray(p).reduce(2), np.int16) for p in (was, now))
    old, new = (255 - colours.min(-1) for colours in (was, now))
    apart = abs(was - now).max(-1)
    shared = 255 - np.minimum(old, new) // 3
    gone, came = apart * (old >= new), apart * (new > old)
    layers = [shared - came, shared - came - gone, shared - gone]
    return _address(Image.fromarray(np.stack(layers, -1).clip(0, 255).astype(np.uint8)))


def _colours(path: Path) -> np.ndarray | None:
    try:
        return read(path).colours
    except DamagedImageError:
        return None


def _address(image: Image.Image) -> str:
    written = BytesIO()
    image.save(written, "png", compress_level=3)
    return address_of(written.getvalue())
