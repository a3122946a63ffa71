"""Build the site of the project's pages and of the library's API reference.

Run `python docs/website/build.py [project]` with the packages of requirements.txt in this folder.
The site is written to build/site/html, and works without a web server. A broken link is an error.
"""

import doctest
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from latex2mathml.converter import convert

CONFIGURATION = Path("docs/website/mkdocs.yml")
PAGES = Path("build/site/pages")
CODE = re.compile(r"(^```.*?^```|`[^`\n]+`)", re.MULTILINE | re.DOTALL)
FORMULA = re.compile(r"\$\$(.+?)\$\$|\$([^$]+)\$", re.DOTALL)
EXAMPLE = re.compile(r"^```(python|pycon)\n(.*?)^```\n", re.MULTILINE | re.DOTALL)
LIBRARY = "packages/latticode/docs/"
"""The folder of pages that are also written as notebooks."""
LINK = re.compile(r"\[((?:[^][]|\[[^]]*\])*)\]\(([^)#\s]+)\)")


def linked_pages(project: Path) -> list[str]:
    """Return the paths of the pages in the navigation of the site."""
    text = (project / CONFIGURATION).read_text("utf-8")
    return re.findall(r"^ +- (\S+\.md)$", text, re.MULTILINE)


def outside_code(pattern: re.Pattern, replacement, text: str) -> str:
    """Return a page with a pattern replaced everywhere except in code."""
    pieces = CODE.split(text)  # alternately text and code
    pieces[::2] = [pattern.sub(replacement, piece) for piece in pieces[::2]]
    return "".join(pieces)


def formula_in_mathml(formula: re.Match) -> str:
    """Return a formula in MathML, which browsers draw without a script.

    A formula within a sentence is in a span: a line that begins with <math> would be a paragraph.
    """
    if formula[1]:
        return f"<div>{convert(formula[1], display='block')}</div>"
    return f"<span>{convert(formula[2])}</span>"


def collect_page(project: Path, page: str) -> None:
    """Copy a page to the folder PAGES of MkDocs, with the pictures and files to which it links.

    A link to a folder becomes plain text, because the site has no page for a folder.
    """
    source = project / page

    def collect_target(link: re.Match) -> str:
        target = Path(os.path.normpath(source.parent / link[2]))
        if target.is_dir():
            return link[1]
        if target.is_file() and target.suffix != ".md":
            copied = project / PAGES / target.relative_to(project)
            copied.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(target, copied)
        return link[0]

    text = outside_code(LINK, collect_target, source.read_text("utf-8"))
    collected = project / PAGES / page
    collected.parent.mkdir(parents=True, exist_ok=True)
    if page.startswith(LIBRARY) and EXAMPLE.search(text):
        collected.with_suffix(".ipynb").write_text(notebook_of(text), "utf-8")
        text += f"\n[This page as a notebook]({collected.stem}.ipynb)\n"
    collected.write_text(outside_code(FORMULA, formula_in_mathml, text), "utf-8")


def notebook_of(text: str) -> str:
    """Return a page as a Jupyter notebook; its examples are cells that show the last figure."""
    cells, end = [], 0
    parse = doctest.DocTestParser().get_examples
    for example in EXAMPLE.finditer(text):
        sources = [example[2]] if example[1] == "python" else [e.source for e in parse(example[2])]
        sentences = re.sub(r"^!\[.*\n", "", text[end : example.start()], flags=re.MULTILINE)
        cells += [("markdown", sentences), ("code", "".join(sources).strip())]
        end = example.end()
    cells += [("markdown", text[end:]), ("code", "figure")]
    output = {"execution_count": None, "outputs": []}
    listed = [
        {"cell_type": kind, "id": f"cell-{i}", "metadata": {}, "source": source}
        | (output if kind == "code" else {})
        for i, (kind, source) in enumerate(cells)
        if source.strip()
    ]
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    metadata = {"kernelspec": kernel}
    return json.dumps(
        {"nbformat": 4, "nbformat_minor": 5, "metadata": metadata, "cells": listed}, indent=1
    )


def build_site(project: Path) -> int:
    """Collect the pages of a project, run MkDocs on them and return its exit code."""
    shutil.rmtree(project / PAGES.parent, ignore_errors=True)
    for page in linked_pages(project):
        collect_page(project, page)
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--config-file", CONFIGURATION]
    return subprocess.run(command, cwd=project).returncode


if __name__ == "__main__":
    sys.exit(build_site(Path(*sys.argv[1:2] or [Path(__file__).parents[2]]).resolve()))
