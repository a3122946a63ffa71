"""Where kernels are kept: found wherever the project lies, never stale, torn, or of other types."""

import os
import pickle
import shutil
import sys
import time
from importlib.util import module_from_spec, spec_from_file_location
from types import ModuleType

import pytest
from latticode.kernels import cache as kernel_cache
from latticode.kernels import sources
from latticode.kernels.cache import UNUSED, VARIABLE, KernelFiles, kept_in
from latticode.kernels.inside_numba import make_kernel

SOURCE = "def double(x):\n    return 2 * x\n"


@pytest.fixture
def module(tmp_path):
    path = tmp_path / "project" / "made.py"
    path.parent.mkdir()
    path.write_text(SOURCE)
    return path


@pytest.fixture
def cache(tmp_path):
    return tmp_path / "kept"


def compile_anew(path, cache):
    """Return what a new process makes of `double`: a compiled function that has run nothing yet."""
    for remembered in (sources.digest_of, sources.digest_of_modules, sources._imports_of):
        remembered.cache_clear()
    spec = spec_from_file_location("made", path)
    built = sys.modules["made"] = module_from_spec(spec)  # kept code names its module
    spec.loader.exec_module(built)
    return make_kernel(built.double, cache)


def hits(compiled) -> int:
    return sum(compiled.stats.cache_hits.values())


def test_each_type_of_argument_has_a_file_of_its_own(module, cache):
    first, second = compile_anew(module, cache), compile_anew(module, cache)
    assert (first(3), second(2.5)) == (6, 5.0)  # neither knew of the other when it was compiled
    third = compile_anew(module, cache)
    assert (third(3), third(2.5), hits(third)) == (6, 5.0, 2)
    assert len(list(cache.rglob("*.kernel"))) == len(list(cache.rglob("*.*"))) == 2


CHAIN = """
from typing import NamedTuple

class Chain(NamedTuple):
    {}: float
    {}: float
"""


@pytest.mark.parametrize("fields", [("charge", "mass"), ("mass", "charge")])
def test_named_tuples_of_one_name_share_no_code(module, cache, monkeypatch, fields):
    """They may differ in the order of their fields, or only in the module of their class."""
    module.write_text("def double(x):\n    return x[0].mass - x[0].charge, x[0]\n")
    for name, order in ("first", ("mass", "charge")), ("second", fields):
        monkeypatch.setitem(sys.modules, name, built := ModuleType(name))
        exec(CHAIN.format(*order), built.__dict__)
        compiled = compile_anew(module, cache)
        chain = built.Chain(mass=3.0, charge=1.0)
        difference, same = compiled((chain,))
        assert difference == 2.0 and type(same) is built.Chain and hits(compiled) == 0


def test_a_copied_project_with_new_time_stamps_finds_its_kernels(module, cache):
    compile_anew(module, cache)(3)
    moved = shutil.copytree(module.parent, module.parent.with_name("copy")) / module.name
    os.utime(moved, (0, 0))
    compiled = compile_anew(moved, cache)
    assert compiled(3) == 6 and hits(compiled) == 1


def test_an_edited_module_or_another_setting_of_the_compiler_finds_none(module, cache, monkeypatch):
    compile_anew(module, cache)(3)
    with monkeypatch.context() as changed:
        changed.setenv("NUMBA_OPT", "1")
        assert hits(compile_anew(module, cache)) == 0 and compile_anew(module, cache)(3) == 6
    # of another length, since Python compares the size of a module and the second of its last edit
    module.write_text(SOURCE.replace("2 * x", "21 * x"))
    edited = compile_anew(module, cache)
    assert edited(3) == 63 and hits(edited) == 0


FOREIGN = pickle.dumps(("of another numba",))
DAMAGE = {
    "cut": lambda file, content: content[:-9],
    "changed": lambda file, content: content[:-1] + b"?",
    "of another numba": lambda file, content: KernelFiles._seal(file, FOREIGN) + FOREIGN,
}


@pytest.mark.parametrize("damage", DAMAGE)
def test_a_damaged_file_is_compiled_and_written_again(module, cache, damage):
    compile_anew(module, cache)(3)
    (file,) = cache.rglob("*.kernel")
    file.write_bytes(DAMAGE[damage](file, file.read_bytes()))
    compiled = compile_anew(module, cache)
    assert compiled(3) == 6 and hits(compiled) == 0
    recomputed = compile_anew(module, cache)  # the lengths differ: numba numbers what it compiles
    assert recomputed(3) == 6 and hits(recomputed) == 1


def test_a_file_that_others_can_write_is_not_loaded(module, cache):
    """Its hash is right, so only its owner or mode can show that it is foreign code."""
    compile_anew(module, cache)(3)
    (file,) = cache.rglob("*.kernel")
    file.chmod(0o666)
    compiled = compile_anew(module, cache)
    assert compiled(3) == 6 and hits(compiled) == 0
    assert file.stat().st_mode & 0o777 == 0o600  # it was compiled and kept again


def test_a_folder_that_others_can_write_is_not_used(monkeypatch, cache):
    cache.mkdir()
    cache.chmod(0o777)
    monkeypatch.setenv(VARIABLE, str(cache))
    with pytest.warns(
        UserWarning, match="another user owns that folder or can write to it.*chmod go-w"
    ):
        assert kept_in() is None


def test_what_nobody_used_for_long_is_removed_when_a_module_is_compiled_anew(module, cache):
    compile_anew(module, cache)(3)
    (old,) = cache.iterdir()
    module.write_text(SOURCE + "# edited\n")
    compile_anew(module, cache)(3)
    assert old.exists()  # a run of another branch may need it tomorrow
    long_ago = time.time() - 2 * UNUSED
    os.utime(old, (long_ago, long_ago))
    module.write_text(SOURCE + "# edited twice\n")
    compile_anew(module, cache)(3)
    assert not old.exists() and len(list(cache.iterdir())) == 2


def test_the_folder_is_the_users_another_or_none(monkeypatch, tmp_path):
    monkeypatch.setenv(VARIABLE, str(tmp_path))
    assert kept_in() == tmp_path
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv(VARIABLE, "~/kernels")
    assert kept_in() == tmp_path / "kernels"
    for word in (kernel_cache.OFF, "OFF", "off "):
        monkeypatch.setenv(VARIABLE, word)
        assert kept_in() is None
    monkeypatch.delenv(VARIABLE)
    assert kept_in() == kernel_cache.platformdirs.user_cache_path("latticode")


def test_code_that_holds_addresses_of_its_process_is_not_kept(module, cache):
    large = "import numpy as np\nTABLE = np.ones(200_000)\n"  # numba compiles in where it lies
    module.write_text(large + SOURCE.replace("2 * x", "2 * x * TABLE[x]"))
    assert compile_anew(module, cache)(3) == 6.0
    assert not list(cache.rglob("*.kernel"))


@pytest.mark.parametrize("mask", [0o000, 0o002, 0o027, 0o077])
def test_folders_are_private_whatever_the_umask(tmp_path, mask):
    root, before = tmp_path / "cache" / "kept", os.umask(mask)
    try:
        kernel_cache._write(root / "module" / "name.kernel", b"code")
    finally:
        os.umask(before)
    built = [root.parent, root, root / "module"]
    assert [path.stat().st_mode & 0o777 for path in built] == [0o700] * 3
    assert kernel_cache._trusted(root) == root
