"""How a picture is judged depends on what was found of the data that it shows."""

import made_up_results as made_up
from made_up_results import CHAOTIC, CHAOTIC_PICTURE, change_a, chaotic
from pendula.figure_diff import DIFFERENT, NEARLY


def plant(run, dataset: str, figure: str, data) -> None:
    made_up.save(run.made / dataset, data)
    made_up.put(run.made, figure, data)


def test_a_picture_of_curves_that_may_move_is_compared_by_its_ink(run):
    plant(run, CHAOTIC, "fig4", chaotic(seed=7))
    assert run.findings()[CHAOTIC_PICTURE].status == NEARLY


def test_a_picture_of_faulty_data_is_a_fault_too(run):
    """The same ink does not excuse it: curves that are wrong may leave as much."""
    plant(run, CHAOTIC, "fig4", change_a(chaotic(seed=7), 0.97))
    found = run.findings()
    assert found["figures/fig4.nc"].status == found[CHAOTIC_PICTURE].status == DIFFERENT
