"""The record of the code behind a function: which files it has, and what of them counts."""

import ast
import io
import tokenize

import pytest
from latticode.kernels import sources

MODULES = sorted((sources.ROOTS["latticode"] / "latticode").rglob("*.py"))


def test_a_template_named_after_a_module_belongs_to_this_module_alone(tmp_path):
    names = ("__init__.py", "section.py", "compute.py", "section.html.j2", "shared.css")
    init, section, compute, template, style = paths = [tmp_path / name for name in names]
    for path in paths:
        path.touch()
    assert sources.attached_to([init, section]) == [template, style]
    assert sources.attached_to([init, compute]) == [style]


@pytest.mark.parametrize(
    "statement",
    [
        "import mine.drawing.style",
        "from mine.drawing import style",
        "from mine.drawing.style import styled",
        "from ..drawing import style",
        "from ..drawing.style import styled",
        "def later():\n    from ..drawing import style",
    ],
)
def test_a_record_follows_every_kind_of_import(tmp_path, monkeypatch, statement):
    monkeypatch.setitem(sources.ROOTS, "mine", tmp_path)
    folder, room = tmp_path / "mine/studies/draw.py", tmp_path / "mine/drawing"
    room.mkdir(parents=True)
    folder.parent.mkdir()
    for path in (room / "__init__.py", room / "style.py", room / "other.py"):
        path.touch()
    folder.write_text(statement)
    assert sources.modules_of(folder) == [room / "__init__.py", room / "style.py", folder]


def imports_in(tree) -> list[str]:
    kinds = ast.Import, ast.ImportFrom
    return sorted(ast.dump(node) for node in sources._statements(tree) if isinstance(node, kinds))


def test_a_record_has_the_imports_that_python_finds():
    """Not everything is parsed, so that what is left out must hold no import."""
    sizes = []
    for module in MODULES:
        text = module.read_text(encoding="utf-8")
        trees = sources._tree_of(text), ast.parse(text)
        assert imports_in(trees[0]) == imports_in(trees[1]), module
        sizes.append([sum(1 for _ in sources._statements(tree)) for tree in trees])
    read, full = map(sum, zip(*sizes, strict=True))
    assert len(sizes) > 70 and read < 0.2 * full


LAYOUT = {tokenize.NL, tokenize.COMMENT, tokenize.INDENT, tokenize.DEDENT, tokenize.NEWLINE}


def tokens_of(text: str) -> list[str]:
    """Return what Python makes of a module, without comments, layout and statements of strings."""
    computed = list(tokenize.generate_tokens(io.StringIO(text).readline))
    computed = [first for first in computed if first.type not in LAYOUT - {tokenize.NEWLINE}]
    ends = [True, *(first.type == tokenize.NEWLINE for first in computed), True]
    alone = [ends[i] and ends[i + 2] for i in range(len(computed))]
    pairs = zip(computed, alone, strict=True)
    retained = [first for first, only in pairs if not (only and first.type == tokenize.STRING)]
    return [first.string for first in retained if first.type != tokenize.NEWLINE]


def test_what_is_left_out_of_the_hash_of_code_is_no_code():
    for module in MODULES:
        text = module.read_text(encoding="utf-8")
        assert tokens_of(sources.strip_comments(text)) == tokens_of(text), module


@pytest.mark.parametrize(
    ("text", "same"),
    [
        ('def f():\n    """Say."""\n    return 1\n', True),
        ("def f():\n    # why\n\n    return 1  # one\n", True),
        ("def f():\n    return 2\n", False),
        ("def f():\n    return '# 1'\n", False),
        ('def f():\n    return """1"""\n', False),
        ("def f():\n  return 1\n", False),
    ],
)
def test_comments_and_docstrings_do_not_count(text, same):
    assert (
        sources.strip_comments(text) == sources.strip_comments("def f():\n    return 1\n")
    ) is same


def test_the_hash_of_code_follows_modules_templates_and_packages(tmp_path, monkeypatch):
    monkeypatch.setitem(sources.ROOTS, "mine", tmp_path)
    page = tmp_path / "mine/page"
    page.mkdir(parents=True)
    (tmp_path / "mine/other.py").write_text("X = 1\n")
    (page / "page.j2").write_text("words")
    (page / "__init__.py").write_text("from mine import other\n")

    def digest():
        for first in (
            sources.digest_of_code,
            sources._digest_of_bare,
            sources.digest_of,
            sources._versions,
            sources._imports_of,
            sources._data_files,
        ):
            first.cache_clear()
        return sources.digest_of_code(page / "__init__.py")

    computed = [digest()]
    (tmp_path / "mine/other.py").write_text("X = 2\n")
    computed.append(digest())
    (page / "page.j2").write_text("other words")
    computed.append(digest())
    monkeypatch.setattr(sources, "version", lambda name: "0")
    computed.append(digest())
    assert len(set(computed)) == 4


def test_an_import_for_type_checkers_is_none(tmp_path, monkeypatch):
    """It is never executed, and what it names decides no number."""
    monkeypatch.setitem(sources.ROOTS, "small", tmp_path)
    (tmp_path / "small").mkdir()
    for name in ("__init__", "used", "named"):
        (tmp_path / f"small/{name}.py").write_text("")
    text = "if TYPE_CHECKING:  # names\n    from small import named\n\nfrom small import used\n"
    (tmp_path / "small/made.py").write_text(text)
    computed = {path.name for path in sources.modules_of(tmp_path / "small/made.py")}
    assert computed == {"made.py", "used.py", "__init__.py"}
