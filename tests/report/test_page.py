"""The page itself: typed numbers, templates, pictures, links, and colours that can be read."""

import ast
import base64
import io
import re
from pathlib import Path

import numpy as np
import pytest
from jinja2 import UndefinedError
from pendula.report import page
from pendula.report.page import PictureError, picture
from pendula.report.results import ReportError, Results
from PIL import Image

HERE = Path(page.__file__).parent
LIBRARY = HERE.parents[1]
SECTIONS = [*LIBRARY.glob("studies/*/section*.py"), LIBRARY / "ledger/section.py",
            LIBRARY / "report/sections.py"]  # fmt: skip
NAMES = (
    r"Figs? \d( (and|to) \d)?|\(\d\)|Theorems? \d( to \d)?|Lemma \d|ode45|DOP853|SHA-256|"
    r"[A-Zγμℓ)|][²³⁵₀]|C₀δ|\(1 \+ \|n\|\)"
)


def typed_numbers(text: str) -> list[str]:
    """Return the numbers in a text for readers, without names and what expressions fill in."""
    text = re.sub(r"<[^>]*>|\{[^}]*\}", " ", text)
    return re.findall(r"\S*[\d²³⁵₀]\S*", re.sub(NAMES, " ", text))


@pytest.mark.parametrize("path", SECTIONS, ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_no_number_is_typed_and_none_is_that_of_a_figure(path):
    """Texts have spaces and names have none; figures only draw, so that no page quotes them."""
    nodes = list(ast.walk(ast.parse(path.read_text(encoding="utf-8"))))
    described = (ast.Module, ast.ClassDef, ast.FunctionDef)
    docstrings = {
        ast.get_docstring(one, clean=False) for one in nodes if isinstance(one, described)
    }
    constants = {one.value for one in nodes if isinstance(one, ast.Constant)}
    texts = {one for one in constants - docstrings if isinstance(one, str)}
    assert not [text for text in texts if text.startswith("figures/")]
    shown = [text for text in texts if " " in text]
    assert shown and [text for text in shown if typed_numbers(text)] == []


@pytest.mark.parametrize("text", ["of 6 cases", "to τ = 50", "10⁻⁶ of P²³", "1 % off"])
def test_a_typed_number_is_found(text):
    assert typed_numbers(text) and not typed_numbers("Figs 2 to 4, γ₀ of Lemma 1, |A|² in {n}")


def test_a_missing_value_is_an_error_and_text_is_escaped(tmp_path):
    (tmp_path / "a.j2").write_text("{{ value }}")
    assert page.render("a.j2", tmp_path, value="<b>") == "&lt;b&gt;"
    with pytest.raises(UndefinedError):
        page.render("a.j2", tmp_path)


def test_a_picture_holds_its_pixels_in_few_colours(tmp_path):
    steps = Image.linear_gradient("L").resize((300, 200))
    turned = steps.transpose(Image.Transpose.ROTATE_180)
    Image.merge("RGB", [steps, turned, steps]).save(tmp_path / "a.png")
    shown = picture(tmp_path / "a.png", "words", "own/cases/a.png")
    assert shown[1:] == (300, 200, "words", "own/cases/a.png") and shown.name == "own-cases-a"
    kind, _, content = shown.address.partition(",")
    read = Image.open(io.BytesIO(base64.b64decode(content)))
    assert kind == "data:image/png;base64" and len(read.getcolors()) <= page.COLOURS
    was = np.asarray(Image.open(tmp_path / "a.png"), dtype=int)
    assert abs(was - np.asarray(read.convert("RGB"))).max() < 16


def test_a_picture_that_is_none_is_named(tmp_path):
    whole = io.BytesIO()
    Image.effect_noise((99, 99), 50).save(whole, "PNG")
    for content in (b"text", b"\x89PNG\r\n\x1a\n" + bytes(100), whole.getvalue()[:3000]):
        (tmp_path / "a.png").write_bytes(content)
        with pytest.raises(PictureError, match=r"a\.png is not a complete PNG: delete it and run"):
            picture(tmp_path / "a.png", "", "")
    with pytest.raises(PictureError, match=r"b\.png is missing: run snakemake"):
        picture(tmp_path / "b.png", "", "")


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


STYLE = (HERE / "style.css").read_text()
LIGHT, DARK = (dict(re.findall(r"--(\w+): (#\w{6});", part)) for part in STYLE.split("@media")[:2])


@pytest.mark.parametrize("colours", [LIGHT, DARK], ids=["light", "dark"])
def test_text_stands_out_from_its_ground(colours):
    """At least 4.5 to 1, as WCAG AA requires."""
    used = set(re.findall(r"(?<![\w-])color: (?:var\(--)?([^;)]+)", STYLE)) - {"inherit"}
    assert len(used) > 5 and contrast("#777777", "#ffffff") == pytest.approx(4.48, abs=0.01)
    for text in used:
        grounds = (colours[ground] for ground in ("paper", "raised"))
        assert min(contrast(colours[text], ground) for ground in grounds) >= 4.5, text
