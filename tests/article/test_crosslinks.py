"""Links inside the article, and its pictures in words."""

import re

import pytest
from facts import Accepted
from html_tags import Tags
from pendula.article.write import ARTICLE
from replication.article import crosslinks
from test_article import PICTURES, linked_source


@pytest.fixture(scope="module")
def text() -> str:
    return linked_source()[0]


def test_every_heading_figure_table_equation_and_reference_has_an_id(text):
    linked = crosslinks.link_mentions(text)
    counts = {"figure": 11, "table": 3, "equation": 2, "reference": 8}
    for kind, least in counts.items():
        numbers = [int(number) for number in re.findall(rf"{{#{kind}-(\d+)[ }}]", linked)]
        assert numbers == list(range(1, len(numbers) + 1)) and len(numbers) >= least, kind
    assert len(re.findall(r"^##.*{#[a-z-]+}$", linked, re.MULTILINE)) == text.count("\n## ")


def test_links_of_the_page_lead_to_its_parts_and_no_mention_is_left_out():
    page = re.sub(r'src="[^"]*"', "", ARTICLE.page(Accepted()))
    tags = Tags(page)
    inside = {link["href"] for link in tags.all("a") if link["href"].startswith("#")}
    assert len(inside) >= 15 and {link[1:] for link in inside} <= set(tags.ids)
    words = re.sub(r"<(a|strong|title)\b.*?</\1>|<[^>]*>", "", page)
    body = words.partition("[1] E. Destyl")[0]
    assert re.findall(r"(?:Figure|Table) \d+|\[\d\]", body) == []
    assert "annotation" not in page


def test_a_mention_of_what_is_not_there_and_a_formula_stay_as_they_are():
    text = "# T\n\nFigure 9, [7] and $x[3]$, Fig 2; Table 1.\n\n**Table 1.** Rows.\n"
    linked = crosslinks.link_mentions(text)
    assert "Figure 9, [7] and $x[3]$, Fig 2; [Table 1](#table-1)." in linked
    assert "[**Table 1.**]{#table-1} Rows." in linked


def test_pictures_are_described_in_words_in_the_page_and_in_the_pdf(text):
    pictures = dict(crosslinks.alternatives(text))
    assert len(pictures) == text.count("\n![")
    assert all(len(words) > 60 and not re.search(r"[\\$*{]", words) for words in pictures.values())
    assert "norms of A and B at Ω = 8" in pictures["/figures/fig2.png"]
    pdf = ARTICLE.pdf(Accepted(), PICTURES)
    assert pdf.count(b"/Alt") >= len(pictures)


def test_tex_without_a_letter_is_reported():
    with pytest.raises(ValueError, match=r"add the TeX .* \\xi"):
        crosslinks.describe_caption(r"**Figure 1.** All $\xi$.")
