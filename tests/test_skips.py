"""Every test that is skipped says why, and what would have it run."""

import ast
import re

import pytest
from helpers import ROOT, package, skip
from skipped import skips_in_words

TESTS = ROOT / "tests"
FORMS = {"skip", "importorskip", "skipif", "skipIf", "skipUnless", "skipTest", "SkipTest", "xfail"}
"""The names by which pytest and unittest skip; `skip` of helpers.py is called by its bare name."""


def other_skips(source: str) -> list[str]:
    """Return the places of a module that skip without `skip` or `package` of helpers.py."""
    tree = ast.parse(source)
    imported = [
        f"line {node.lineno}: {alias.name} of {node.module}"
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and node.module != "helpers"
        for alias in node.names
        if alias.name in FORMS
    ]
    used = [
        f"line {node.lineno}: .{node.attr}"
        for node in ast.walk(tree)
        if isinstance(node, ast.Attribute) and node.attr in FORMS
    ]
    return imported + used


def test_no_test_is_skipped_in_another_form():
    sources = {path: path.read_text() for path in TESTS.rglob("*.py")}
    # whoever skips names the form; it takes longer to parse a module than to search it
    may_skip = [path for path, text in sources.items() if any(form in text for form in FORMS)]
    found = {str(path): other_skips(sources[path]) for path in may_skip}
    assert len(found.pop(str(TESTS / "helpers.py"))) == 1
    assert {path: places for path, places in found.items() if places} == {}


OTHER_FORMS = [
    "import pytest\npytest.skip('no')",
    "import pytest as p\nmodule = p.importorskip('heyoka')",
    "@pytest.mark.skipif(True, reason='no')\ndef test(): pass",
    "from pytest import skip",
    "from unittest import SkipTest",
]


def test_other_forms_are_found():
    assert [source for source in OTHER_FORMS if not other_skips(source)] == []


def test_a_skip_says_why_and_the_way_to_have_it_run():
    with pytest.raises(BaseException, match=r"^no ship; to have it run: build one$"):
        skip("no ship", "build one")


def test_a_package_is_returned_or_named_with_its_installation():
    assert package("json", "json") is __import__("json")
    wanted = "no_such_package is not installed; to have it run: pip install -r list.txt"
    with pytest.raises(BaseException, match=f"^{re.escape(wanted)}$"):
        package("no_such_package.part", "-r list.txt")


def test_equal_reasons_are_one_group_with_all_its_tests():
    def report(name, said):
        made = pytest.TestReport(name, ("a.py", 1, name), {}, "skipped", None, "setup")
        made.longrepr = ("a.py", 1, f"Skipped: {said}")
        return made

    reports = [report("one", "x"), report("two", "y"), report("three", "x"), report("one", "x")]
    assert skips_in_words(reports) == [
        "2 skipped: x", "    one", "    three", "1 skipped: y", "    two",
    ]  # fmt: skip
