"""Words of the live page that other pages use too."""

import re

from helpers import ROOT
from pendula.article.write import ARTICLE
from pendula.live import write as live
from pendula.live.kernel import compile_for_any_processor
from pendula.studies.breathers import figures


def test_localised_is_one_word_with_one_definition():
    """In the live page, in the article, in the figure of fates and in the terms of ARCHITECTURE."""
    files = (
        live.THIS_FOLDER / "live.html.j2",
        ARTICLE.folder / "article.md.j2",
        ROOT / "ARCHITECTURE.md",
    )
    texts = [figures.FATES_CAPTION, *(file.read_text(encoding="utf-8") for file in files)]
    defined = "central pair and its neighbours hold more than half of P"
    for text in texts:
        assert defined in re.sub(r"\s+", " ", text.replace("$P$", "P"))
    assert "stays localised" in figures.KINDS


def test_processors_of_two_makes_compile_the_same_webassembly(monkeypatch):
    """numba would order operations for the one that it is told of."""
    modules = []
    for name in ("core2", "znver3"):
        monkeypatch.setenv("NUMBA_CPU_NAME", name)
        modules.append(compile_for_any_processor())
    assert modules[0] == modules[1] and modules[0].startswith(b"\0asm")
