"""The page itself: templates, pictures, style."""

import re
import struct
from pathlib import Path

import pytest
from jinja2 import UndefinedError
from pendula.report import page
from pendula.report.page import END, PictureError, picture
from pendula.report.results import ReportError, Results

HERE = Path(page.__file__).parent
NAMES = (
    r"Fig[s]? \d( (and|to) \d)?|\(\d\)|Theorem[s]? \d( to \d)?|Lemma \d|ode45|DOP853|"
    r"SHA-256|μ²|ℓ²|h[123]|2γ|τ = μ²t/2|\(−1\)|x, 0|−H &gt; 0|needs 2γ|\(2\d\)|\(1 \+ \|n\|\)|"
    r"3/2 − s in|1 − s in|s = 1, above it 1/2"
)


TEMPLATES = [HERE / "templates/sections.html.j2", *page.STUDIES.glob("*/section.html.j2")]


@pytest.mark.parametrize("template", TEMPLATES, ids=lambda path: path.parent.name)
def test_no_number_is_typed_in_a_template(template):
    text = template.read_text(encoding="utf-8")
    text = re.sub(r"\{[{%#].*?[}%#]\}", " ", text, flags=re.DOTALL)
    text = re.sub(r"<svg.*?</svg>", " ", text, flags=re.DOTALL)
    text = re.sub(r"<[^>]*>", " ", text)
    text = re.sub(NAMES, " ", text)
    assert not re.findall(r"\S*\d\S*", text)


def test_a_missing_value_is_an_error_and_text_is_escaped(tmp_path, monkeypatch):
    for name in ("style.css", "script.js"):
        (tmp_path / name).write_text(f"/* {name} > */")
    (tmp_path / "a.j2").write_text("{{ style }} {{ script }} {{ value }}")
    monkeypatch.setattr(page, "HERE", tmp_path)
    assert (
        page.render("a.j2", tmp_path, value="<b>")
        == "/* style.css > */ /* script.js > */ &lt;b&gt;"
    )
    with pytest.raises(UndefinedError):
        page.render("a.j2", tmp_path)


def test_a_picture_holds_its_bytes_and_knows_its_size(tmp_path):
    png = b"\x89PNG\r\n\x1a\n" + struct.pack(">I", 13) + b"IHDR" + struct.pack(">II", 30, 20)
    (tmp_path / "a.png").write_bytes(png + END)
    shown = picture(tmp_path / "a.png", "words", "figures/a.png")
    assert (shown.width, shown.height, shown.alt) == (30, 20, "words")
    assert shown.address.startswith("data:image/png;base64,iVBOR")


def test_a_picture_that_is_none_is_named(tmp_path):
    (tmp_path / "a.png").write_text("text")
    with pytest.raises(PictureError, match=r"a\.png is no whole PNG"):
        picture(tmp_path / "a.png", "", "")
    with pytest.raises(PictureError, match=r"b\.png is missing: run snakemake"):
        picture(tmp_path / "b.png", "", "")


def test_half_of_a_picture_is_none(tmp_path):
    (tmp_path / "a.png").write_bytes(b"\x89PNG\r\n\x1a\n" + bytes(100))
    with pytest.raises(PictureError, match=r"a\.png is no whole PNG: delete it and run snakemake"):
        picture(tmp_path / "a.png", "", "")


def test_links_are_seen_from_the_page():
    results = Results(["out/checks/a.nc", "out/claims.json"], "out/report.html")
    assert results.say("checks/a", "1").link == "checks/a.nc"
    assert results.say("claims.json", "1").link == "claims.json"
    with pytest.raises(ReportError, match=r"needs checks/b.*add it to the inputs"):
        results.say("checks/b", "1")


def luminance(colour: str) -> float:
    parts = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.03928 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
    return sum(weight * c for weight, c in zip((0.2126, 0.7152, 0.0722), linear, strict=True))


def contrast(one: str, other: str) -> float:
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


COLOURS = dict(re.findall(r"--(\w+): (#\w{6});", (HERE / "style.css").read_text()))


@pytest.mark.parametrize("text", ["ink", "soft", "link", "good", "caveat", "bad", "open"])
@pytest.mark.parametrize("ground", ["paper", "raised"])
def test_text_stands_out_from_its_ground(text, ground):
    """At least 4.5 to 1, as WCAG AA asks for."""
    assert contrast(COLOURS[text], COLOURS[ground]) >= 4.5


def test_the_measure_of_contrast():
    assert contrast("#ffffff", "#000000") == pytest.approx(21)
    assert contrast("#777777", "#ffffff") == pytest.approx(4.48, abs=0.01)


def test_every_colour_of_text_is_among_those_that_are_checked():
    used = set(re.findall(r"(?<![\w-])color: ([^;]+);", (HERE / "style.css").read_text()))
    assert used <= {*(f"var(--{name})" for name in COLOURS), "inherit"}
