"""Words of the live page that other pages use too."""

import re

from helpers import ROOT
from pendula.article import write as article
from pendula.live import write as live
from pendula.studies.breathers import figures


def test_localised_is_one_word_with_one_definition():
    """In the live page, in the article, in the figure of fates and in the terms of ARCHITECTURE."""
    files = (live.HERE / "live.html.j2", article.HERE / "article.md.j2", ROOT / "ARCHITECTURE.md")
    texts = [figures.FATES_CAPTION, *(file.read_text(encoding="utf-8") for file in files)]
    defined = "central pair and its neighbours hold more than half of P"
    for text in texts:
        assert defined in re.sub(r"\s+", " ", text.replace("$P$", "P"))
    assert "stays localised" in figures.KINDS
