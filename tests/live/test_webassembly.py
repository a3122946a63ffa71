"""What makes a module of a kernel; tests/browser runs it, and compares the bits."""

import pytest
from pendula.figure_diff.compare_shown import comparable
from pendula.live.webassembly import WebAssemblyError, _for_small_pointers, webassembly

STRUCTURE = "{ ptr, ptr, i64, double, [3 x i64] }"


def test_what_lies_on_the_stack_keeps_the_size_of_this_machine():
    code = _for_small_pointers(f"  %a = alloca {STRUCTURE}, align 8\n  %b = alloca ptr\n", "e")
    assert code == "  %a = alloca [56 x i8], align 8\n  %b = alloca [8 x i8]\n"


@pytest.mark.parametrize("use", ["load {}, ptr %a", "getelementptr {}, ptr %a, i64 0, i32 4"])
def test_code_that_rests_on_the_size_of_a_pointer_is_refused(use):
    with pytest.raises(WebAssemblyError, match="this rests on the size of a pointer: %b = "):
        _for_small_pointers(f"  %b = {use.format(STRUCTURE)}\n", "e")


def test_a_module_is_whole_and_names_no_file_of_this_machine():
    module = webassembly("taylor")
    assert module.startswith(b"\0asm\1\0\0\0") and b"\3run\0" in module
    assert b".py" not in module


def test_the_comparison_of_runs_leaves_out_the_code_for_a_processor():
    pages = (b'{"code": "AA==", "marks": "%s"}' % marks for marks in (b"B", b"C"))
    one, other = (comparable("live.html", page) for page in pages)
    assert b"AA==" not in one and one != other
