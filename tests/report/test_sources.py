"""Where the report's numbers come from."""

import re

import pytest
from pendula.report import page


@pytest.mark.parametrize("folder", ["studies", "ledger", "report"])
def test_no_module_names_the_data_of_a_figure(folder):
    """Figures only draw: their data are quoted nowhere, by the name that `Results` would take."""
    root = page.STUDIES.parent / folder
    texts = [path.read_text(encoding="utf-8") for path in root.rglob("*.py")]
    assert len(texts) > 3
    assert not [text for text in texts if re.search(r"[\"']figures/(?!\{name\}\.png)", text)]
