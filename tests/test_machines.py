"""That each machine is played: otherwise a comparison of two machines would compare one."""

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
