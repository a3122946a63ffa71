"""What makes a module of a kernel, and what loads it; the replication runs one in a browser."""

import base64
import json
import shutil
import subprocess

import numpy as np
import pytest
from latticode.kernels.compiled import kernel
from latticode.kernels.webassembly import (
    WebAssemblyError,
    _for_small_pointers,
    loader,
    webassembly,
)

STRUCTURE = "{ ptr, ptr, i64, double, [3 x i64] }"


def test_what_lies_on_the_stack_keeps_the_size_of_this_machine():
    code = _for_small_pointers(f"  %a = alloca {STRUCTURE}, align 8\n  %b = alloca ptr\n", "e")
    assert code == "  %a = alloca [56 x i8], align 8\n  %b = alloca [8 x i8]\n"


@pytest.mark.parametrize("use", ["load {}, ptr %a", "getelementptr {}, ptr %a, i64 0, i32 4"])
def test_code_that_rests_on_the_size_of_a_pointer_is_refused(use):
    with pytest.raises(WebAssemblyError, match="this line depends on the size of a pointer: %b = "):
        _for_small_pointers(f"  %b = {use.format(STRUCTURE)}\n", "e")


@kernel
def add_scaled(factor, y, out):
    for i in range(y.size):
        out[i] += factor * y[i]


@kernel
def add(y, out):  # part of the name of the kernel that it calls
    add_scaled(1.0, y, out)


@pytest.mark.parametrize(("method", "numbers"), [(add_scaled, (0.0,)), (add, ())])
def test_a_module_is_whole_and_names_no_file_of_this_machine(method, numbers):
    module = webassembly(method, *numbers, np.zeros(1), np.zeros(1))
    assert module.startswith(b"\0asm\1\0\0\0") and b"\3run\0" in module
    assert b".py" not in module


def test_a_kernel_that_numba_compiled_in_its_own_way_is_refused():
    class OfAnotherNumba:
        py_func = add_scaled.py_func

    with pytest.raises(WebAssemblyError, match=r"counts references, .* install numba"):
        webassembly(OfAnotherNumba(), 0.0, np.zeros(1), np.zeros(1))


@kernel
def turned(factor, start, most, grid):
    """Use what the loader provides: the next number, and an array in another shape."""
    rows = grid.reshape((2, 3))
    for i in range(3):
        column = rows[:, i]  # whose numbers are found by their strides
        column[1] = factor * column[0] + np.nextafter(start[i], most)
    return rows[1, 0]


@pytest.mark.skipif(not shutil.which("node"), reason="there is no node: apt-get install nodejs")
def test_the_loader_gives_the_bits_of_this_machine(tmp_path):
    """Of numbers and arrays that a kernel takes, of what it writes and of what it returns."""
    start, grid = np.array([1.0, 1.9, 1e-300]), np.array([0.1, 0.2, 0.3, 0.0, 0.0, 0.0])
    case = (1.7, start, np.inf, grid)
    code = base64.b64encode(webassembly(turned, *case)).decode()
    script = f"""{loader()}
    loadKernel(Buffer.from("{code}", "base64")).then(({{ clear, array, call }}) => {{
      array(7);
      clear();
      const [outcome, start, grid] = [array(1), array(3), array(6)];
      start.values.set({start.tolist()});
      grid.values.set({grid.tolist()});
      const error = call(outcome, 1.7, start, Infinity, grid);
      console.log(JSON.stringify([error, outcome.values[0], ...grid.values]));
    }});"""
    (tmp_path / "run.js").write_text(script)
    ran = subprocess.run(["node", tmp_path / "run.js"], capture_output=True, text=True, check=True)
    returned = turned(*case)
    assert json.loads(ran.stdout) == [0, returned, *grid]
    assert grid[3] == 1.7 * 0.1 + np.nextafter(1.0, 2.0)
