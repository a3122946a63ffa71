"""What `snakemake --report` writes beside figures and datasets."""

import pytest
from accepted import BASELINE, dataset
from pendula.workflow.files import figure_files
from pendula.workflow.report_labels import folder_of, label_dataset, label_figure


def test_a_figure_is_labelled_by_its_name_and_the_beginning_of_its_caption():
    (label,) = label_figure(None, figure_files(f"{BASELINE}/figures/fig5")).values()
    sentence = dataset("figures/fig5").attrs["caption"].partition(". ")[0]
    assert label == f"fig5: {sentence}"
    (label,) = label_figure(None, figure_files(f"{BASELINE}/figures/fates")).values()
    assert label == "fates: Fate of an excited central pair at τ = 70, for each Ω, by its …"


@pytest.mark.parametrize(("place", "name"), [(0, "solvers"), (1, "trust")])
def test_each_dataset_of_a_job_is_labelled_by_its_own_name_and_title(place, name):
    """By one label: of two results the page makes a switch of a second label, and breaks."""
    output = [f"{BASELINE}/checks/solvers.nc", f"{BASELINE}/checks/trust.nc"]
    (label,) = label_dataset(None, output, place=place).values()
    assert label == f"{name}: {dataset(f'checks/{name}').attrs['title']}"
    assert folder_of(None, output) == "checks"
