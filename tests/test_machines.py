"""That each machine is played: otherwise a comparison of two machines would compare one."""

from dataclasses import replace
from functools import cache

import machines
import pytest
from helpers import need_machine
from machines import PLAYED, THIS_ONE

found_on = cache(machines.found_on)


@pytest.mark.parametrize("name", PLAYED)
def test_each_library_chooses_the_code_of_the_machine(name):
    need_machine(name)
    found, machine = found_on(name), PLAYED[name]
    assert set(found["numpy"]) == machine.numpy
    assert found["openblas"] == [machine.openblas]
    assert found["numba"] == machine.numba[0]


@pytest.mark.parametrize("name", PLAYED)
def test_the_c_library_has_other_bits_without_fused_operations_only(name):
    need_machine(name)
    assert (found_on(name)["libm"] == found_on(THIS_ONE)["libm"]) == PLAYED[name].fused


def test_this_one_is_as_it_is_whatever_machine_is_played_around_it(monkeypatch):
    for variable in machines.VARIABLES:
        monkeypatch.delenv(variable, raising=False)
    plain = machines.environment(THIS_ONE)
    for variable, value in machines.settings(PLAYED["generic"]).items():
        monkeypatch.setenv(variable, value)
    assert machines.environment(THIS_ONE) == plain


def test_features_that_numpy_does_not_know_are_an_error_in_words():
    renamed = replace(PLAYED["avx2"], numpy=frozenset({"X86_V3", "AVX2_OF_OLD"}))
    with pytest.raises(ValueError, match=r"knows no features AVX2_OF_OLD, but .*X86_V3"):
        machines.settings(renamed)
