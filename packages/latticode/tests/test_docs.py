"""Every example of the README and of the pages is run as it is printed."""

import doctest
import re
from pathlib import Path

import pytest

HOME = Path(__file__).resolve().parents[1]
PAGES = sorted((HOME / "docs").glob("*.md"))


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_examples_of_a_page_run(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = "\n".join(re.findall(r"^```pycon\n(.*?)^```", page.read_text(), re.M | re.S))
    parsed = doctest.DocTestParser().get_doctest(text, {}, page.name, str(page), 0)
    output: list[str] = []
    runner = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE)
    runner.run(parsed, out=output.append)
    assert runner.tries > 3 and runner.failures == 0, "".join(output)


def test_the_first_example_makes_its_plot(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (code,) = re.findall(r"^```python\n(.*?)^```", (HOME / "README.md").read_text(), re.M | re.S)
    exec(compile(code, "README.md", "exec"), {})
    assert (tmp_path / "norms.png").stat().st_size > 10_000


def test_the_readme_names_every_page():
    linked = re.findall(r"\(docs/(\w+\.md)\)", (HOME / "README.md").read_text())
    assert sorted(linked) == [page.name for page in PAGES]
