"""No module imports, by way of others, itself: also not inside a function."""

import pytest
from latticode.kernels import sources
from rooms import circles_in

PACKAGE = sources.ROOTS["latticode"] / "latticode"


def test_no_modules_of_the_library_import_each_other_in_a_circle():
    assert circles_in(PACKAGE) == []


@pytest.mark.parametrize("line", ["from latticode.b import y", "def f():\n    from . import b"])
def test_a_circle_is_found_whether_its_import_is_outside_or_inside_a_function(line, tmp_path):
    package = tmp_path / "latticode"
    package.mkdir()
    (package / "__init__.py").touch()
    (package / "a.py").write_text(line)
    (package / "b.py").write_text("from .c import z")
    (package / "c.py").write_text("import latticode.a")
    (package / "d.py").write_text("from .a import x")
    assert circles_in(package) == [["a", "b", "c"]]
