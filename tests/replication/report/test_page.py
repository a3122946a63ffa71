"""The page itself: what it says first, what it folds, and that text is escaped."""

import base64
import hashlib
import re
from collections import Counter

import pytest
from accepted import BASELINE, ROOT
from html_tags import Tags
from latticode.datasets.json_files import load_json, sealed
from pendula.jobs.report import PAPER
from replication.report import document
from replication.report.described import DescribedFigure

ROWS = [
    {"kind": "observation", "fact": ""} | row for row in load_json(BASELINE / "claims.json")["rows"]
]
NASTY = "<script>alert(1)</script> {0.__class__} & {{ 7 }}"


@pytest.fixture
def written(tmp_path, monkeypatch):
    """Return a function: the page on rows of the ledger and captions, without datasets."""
    monkeypatch.setattr(
        document,
        "figure",
        lambda path, folder, links: DescribedFigure(
            f"figures/{path.stem}",
            NASTY if path.stem == "extra" else f"{path.stem} is shown.",
            30,
            20,
        ),
    )

    def write(rows, differs=()):
        (tmp_path / "claims.json").write_text(sealed({"rows": list(rows)}))
        names = [*PAPER.figures, "extra"]
        path = tmp_path / "report.html"
        document.write_report(
            PAPER, [], names, str(tmp_path / "claims.json"), dict(differs), str(path)
        )
        return path.read_text(encoding="utf-8")

    return write


def text_of(html: str) -> str:
    text = re.sub(r"<style>.*?</style>|<nav.*?</nav>|<[^>]*>", " ", html, flags=re.DOTALL)
    return " ".join(text.replace("\N{NO-BREAK SPACE}", " ").split())


def row(name: str) -> dict:
    return next(claim for claim in ROWS if claim["name"] == name)


def test_the_page_begins_with_the_verdicts_and_the_papers_figures(written):
    held = row("fig5_decreases") | {"verdict": "confirmed"}
    text = text_of(written([held, held | {"name": "other", "verdict": "not reproduced"}]))
    assert "2 claims of the paper: 1 confirmed, 1 not reproduced." in text
    table = text[text.index("figure verdict claims") :]
    assert "Fig 1 : fig1 is shown a drawing none" in table
    assert "holds, except for 1 of the claims 1 confirmed , 1 not reproduced" in table


@pytest.mark.parametrize(
    ("verdicts", "words"),
    [
        (("confirmed",), "holds 1 confirmed"),
        (("confirmed with a caveat",), "holds with a caveat 1"),
        (("not reproduced",), "does not hold 1"),
        (("cannot be decided",), "does not hold 1 cannot"),
        (("confirmed", "not applicable"), "not applicable 1 confirmed"),
    ],
)
def test_a_figure_has_the_verdict_of_its_claims(written, verdicts, words):
    rows = [
        row("fig5_decreases") | {"name": f"row{n}", "verdict": verdict}
        for n, verdict in enumerate(verdicts)
    ]
    line, *_ = re.findall(r'<a href="#figures/fig5">.*?</tr>', written(rows), re.DOTALL)
    assert f"fig5 is shown {words}" in text_of(line)


def test_each_claim_is_shown_once_and_the_confirmed_ones_are_folded(written):
    html = written(ROWS)
    tags = Tags(html)
    assert tags.faults == [] and tags.open == []
    assert sorted(re.findall(r'class="claim" id="claim_(\w+)"', html)) == sorted(
        claim["name"] for claim in ROWS
    )
    opened = re.sub(r"<section[^>]*>\s*<details>.*?</section>", "", html, flags=re.DOTALL)
    opened_claims = set(re.findall(r'id="claim_(\w+)"', opened))
    assert opened_claims == {claim["name"] for claim in ROWS if "confirmed" not in claim["verdict"]}


def counts_of(text: str) -> dict[str, int]:
    """Return by verdict the counts of a text such as "2 confirmed, 1 not reproduced"."""
    pairs = re.findall(r"(\d+) ([a-z][a-z ]*[a-z])", text)
    return {verdict.replace("do not", "does not"): int(count) for count, verdict in pairs}


def of_paper(rows) -> dict[str, int]:
    """Return by verdict how many claims of the paper have it."""
    return dict(Counter(row["verdict"] for row in rows if row["origin"] == "of the paper"))


def test_the_lead_and_the_headings_of_the_report_count_each_claim_once(written):
    text = text_of(written(ROWS))
    lead = re.search(r"\d+ claims of the paper: (.*?);", text)[1]
    assert counts_of(lead) == of_paper(ROWS)
    headings = re.findall(r"(\d+) claims (confirmed(?: with a caveat)?): (.*?project)", text)
    assert len(headings) == 2
    for count, verdict, origins in headings:
        by_origin = counts_of(origins)
        assert sum(by_origin.values()) == int(count)
        assert by_origin["of the paper"] == of_paper(ROWS)[verdict]
        assert by_origin == dict(
            Counter(row["origin"] for row in ROWS if row["verdict"] == verdict)
        )


def test_the_readme_and_the_article_have_the_counts_of_the_ledger():
    counts = of_paper(ROWS)
    confirmed, caveat = counts["confirmed"], counts["confirmed with a caveat"]
    negative = [
        counts.get(word, 0) for word in ("not reproduced", "does not follow", "cannot be decided")
    ]
    readme, article = (
        " ".join((ROOT / name).read_text("utf-8").split())
        for name in ("README.md", "docs/article.md")
    )
    match = re.search(
        r"of (\d+) claims of the paper (\d+) are confirmed and (\d+) with a caveat; (\d+)"
        r" are not reproduced, (\d+) do not follow .*?, and (\d+) cannot be decided",
        readme,
    )
    assert list(map(int, match.groups())) == [sum(counts.values()), confirmed, caveat, *negative]
    match = re.search(
        r"test (\d+) statements: .*? We confirm (\d+) statements, (\d+) of them with a caveat"
        r".*? We do not reproduce (\d+) statements: .*? The paper's (\d+) conclusions .*?"
        r" Another (\d+) statements cannot be decided",
        article,
    )
    held = [sum(counts.values()), confirmed + caveat, caveat]
    assert list(map(int, match.groups())) == [*held, *negative]


def test_the_article_has_the_words_of_the_report_on_each_figure(written):
    article = (ROOT / "docs/article.md").read_text("utf-8")
    table = text_of(written(ROWS)).partition("figure verdict claims")[2]
    for figure in range(1, 7):
        cells = re.search(rf"^\| {figure} \|.*$", article, re.MULTILINE)[0].split("|")
        word, counts = cells[3].partition(";")[0].strip(), cells[4].strip()
        entry = f"Fig {figure} : fig{figure} is shown {word} {counts}"
        assert entry in table.replace(" ,", ",")


def test_what_files_say_is_never_markup(written):
    """Captions and sentences are values: nothing in them is a tag, a field or a template."""
    hostile = row("fig5_decreases") | {"says": NASTY, "because": NASTY, "criterion": NASTY}
    hostile |= {"measured": {NASTY: NASTY}, "verdict": "not reproduced"}
    html = written([hostile], {"omega": NASTY})
    assert html.count("<script") == 1 and html.count("&lt;script&gt;alert(1)") >= 6
    assert html.count("{0.__class__} &amp; {{ 7 }}") >= 3


def test_the_page_allows_its_own_style_script_and_pictures_beside_it_alone(written):
    html = written([row("fig5_decreases")])
    (policy,) = (tag["content"] for tag in Tags(html).all("meta") if "http-equiv" in tag)
    digests = {}
    for tag in ("style", "script"):
        (text,) = re.findall(rf"<{tag}>(.*?)</{tag}>", html, re.DOTALL)
        digests[tag] = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
    sources = "script-src 'sha256-{script}'; style-src 'sha256-{style}'".format(**digests)
    assert policy.startswith(f"default-src 'none'; {sources}; img-src 'self'")
    assert "style=" not in html
