"""The site has every page and every public name, and an error in a link stops its build."""

import os
import re
import shutil
import subprocess
import sys
from importlib.util import find_spec, module_from_spec, spec_from_file_location

import latticode
import nbformat
import pytest
from helpers import ROOT, skip

SITE = ROOT / "docs/website"
FOLDERS = ("docs", "packages", "config", "tests/baseline/figures", "tests/baseline/speed")
"""Where pages and what they link to are."""


@pytest.fixture(scope="module")
def project(tmp_path_factory):
    """Return a copy of the pages and of the library."""
    if find_spec("mkdocstrings") is None:
        skip("MkDocs is not installed", f"pip install -r {SITE.relative_to(ROOT)}/requirements.txt")
    copy = tmp_path_factory.mktemp("site") / "project"
    leave_out = shutil.ignore_patterns("tests", "build", "__pycache__")
    for folder in FOLDERS:
        shutil.copytree(ROOT / folder, copy / folder, ignore=leave_out, dirs_exist_ok=True)
    for path in [*ROOT.glob("*.md"), *ROOT.glob("LICENSE*"), ROOT / "CITATION.cff"]:
        shutil.copyfile(path, copy / path.name)
    return copy


def build(project) -> subprocess.CompletedProcess:
    command = [sys.executable, SITE / "build.py", project]
    environment = {**os.environ, "NO_MKDOCS_2_WARNING": "1"}
    return subprocess.run(command, env=environment, capture_output=True, text=True)


def test_the_site_is_built_with_formulas_and_docstrings(project):
    done = build(project)
    assert done.returncode == 0, done.stdout + done.stderr
    html = project / "build/site/html"
    assert "<math" in (html / "packages/latticode/docs/gallery/toda.html").read_text()
    reference = (html / "docs/website/api.html").read_text()
    assert [name for name in latticode.__all__ if f'id="latticode.{name}"' not in reference] == []
    notebooks = sorted((html / "packages/latticode/docs").rglob("*.ipynb"))
    assert len(notebooks) >= 21
    for notebook in notebooks:
        nbformat.validate(nbformat.read(notebook, as_version=4))
    assert "the root of the sum" in reference  # of the docstring of `simulate`


@pytest.mark.parametrize("name", ["files", "localised", "gallery/toda"])
def test_a_page_runs_as_a_notebook(project, name, tmp_path):
    if find_spec("nbclient") is None or find_spec("ipykernel") is None:
        skip("nbclient is not installed", "pip install nbclient ipykernel")
    from nbclient import NotebookClient

    if not (project / "build/site/html").exists():
        build(project)
    notebook = project / f"build/site/html/packages/latticode/docs/{name}.ipynb"
    cells = nbformat.read(notebook, as_version=4)
    NotebookClient(cells, resources={"metadata": {"path": str(tmp_path)}}).execute()
    (picture,) = cells.cells[-1].outputs
    assert "image/png" in picture.data


@pytest.mark.parametrize("link", ["(equation.md)", "(equations.md#no-such-heading)"])
def test_a_link_that_leads_nowhere_stops_the_build_and_is_named(project, link):
    page = project / "packages/latticode/docs/chaos.md"
    text = page.read_text()
    page.write_text(f"{text}\n[lost]{link}\n")
    done = build(project)
    page.write_text(text)
    assert done.returncode == 1 and link[1:-1] in done.stderr, done.stdout + done.stderr


def test_every_page_is_in_the_navigation_once():
    pages = [*ROOT.glob("docs/*.md"), *ROOT.glob("packages/latticode/docs/**/*.md")]
    pages += [ROOT / "README.md", ROOT / "packages/latticode/README.md", SITE / "api.md"]
    named = re.findall(r"^ +- (\S+\.md)$", (SITE / "mkdocs.yml").read_text(), re.MULTILINE)
    assert len(set(named)) == len(named)
    assert {str(page.relative_to(ROOT)) for page in pages} <= set(named)


def test_the_reference_names_every_public_name_once():
    named = re.findall(r"^::: latticode\.(\w+)$", (SITE / "api.md").read_text(), re.MULTILINE)
    assert sorted(named) == latticode.__all__


def test_docstrings_become_markdown():
    if find_spec("griffe") is None:
        skip("griffe is not installed", f"pip install -r {SITE.relative_to(ROOT)}/requirements.txt")
    spec = spec_from_file_location("docstrings", SITE / "docstrings.py")
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    written = "Simulate.\n\nRaises it. As:\ncase: what\n    it is.\n\n>>> 1 + 1\n2\n\nThe end."
    assert module.as_markdown(written) == (
        "Simulate.\n\nRaises it. As:\n\n- `case`: what\n    it is.\n\n"
        "```pycon\n>>> 1 + 1\n2\n```\n\nThe end."
    )
