"""The fonts from which PDFs take their letters."""

import re
import zlib
from io import BytesIO
from pathlib import Path

import pytest
import xarray as xr
from fontTools.ttLib import TTFont
from latticode.drawing import style
from latticode.drawing.light_fonts import LEFT_OUT, SLANTS, light_fonts
from matplotlib.font_manager import FontProperties, findfont

STREAM = re.compile(rb"/Length1.*?stream\r?\n(.*?)\r?\nendstream", re.DOTALL)
"""Of a font in a PDF; only fonts have a Length1."""


def font_of(slant):
    return Path(findfont(FontProperties(family="DejaVu Sans", style=slant)))


@pytest.mark.parametrize("slant", SLANTS)
def test_no_letter_is_lost_and_the_whole_font_is_found_afterwards(slant):
    full_font = font_of(slant)
    with light_fonts():
        assert font_of(slant) != full_font
        with TTFont(font_of(slant)) as light, TTFont(full_font) as full:
            assert light.getBestCmap() == full.getBestCmap()
            assert not set(LEFT_OUT) & set(light.keys())
            assert dict(light["kern"].kernTables[0].kernTable)
    assert font_of(slant) == full_font


def test_a_pdf_holds_as_truetype_the_letters_of_any_name(tmp_path):
    figure = style.new_figure(3.0, 2.0)
    figure.add_subplot().set_title("fi Ψ ł ж ℓ é $\\Omega_ß$")
    names = ("f.png", "f.pdf", "f.nc", "f.json")
    style.save(figure, xr.Dataset(), *(tmp_path / name for name in names))
    content = (tmp_path / "f.pdf").read_bytes()
    fonts = [TTFont(BytesIO(zlib.decompress(font))) for font in STREAM.findall(content)]
    letters = {name for font in fonts for name in font.getGlyphOrder()}
    expected = {"f", "i", "Psi", "lslash", "uni0436", "eacute", "Omega", "germandbls"}
    assert expected <= letters and b"/Type3" not in content
