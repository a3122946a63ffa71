"""The paper's equations as a model of one's own, and what a configuration has of each."""

import numpy as np
import pytest
from latticode import Model, save, survey
from latticode.drawing import style
from latticode.drawing.surveys import draw_survey, gather_survey
from pendula import Case, check, simulate
from pendula.own_cases import answers
from pendula.own_cases.page import write_report, write_table

KINDS = "png", "pdf", "nc", "json"

AMPLITUDES = """from latticode import abs2
from pendula.models.equations import i_dt
fields = "A", "B"
parameters = {"epsilon": 1.0, "gamma": 1.0, "omega": -4.0}
def conserved(p, a, b):
    def of(u):
        return abs2(u) ** 2 / 4 + p.omega * abs2(u) - p.epsilon * abs2(u.right - u)
    return {"H": of(a) + of(b) - p.gamma * ((a - b) ** 2).real}
"""


def test_the_papers_equations_as_a_model_of_ones_own_give_the_papers_run(tmp_path):
    data = {"half_width": 5, "initial": {0: (1, 0.1), 2: (0.2j, 0)}, "end_time": 6}
    (tmp_path / "amplitudes.py").write_text(AMPLITUDES, encoding="utf-8")
    model = Model.read(tmp_path / "amplitudes.py")
    of_model, paper = Case(model=model, **data), Case(omega=-4, **data)
    run, expected = simulate(of_model), simulate(paper)
    np.testing.assert_array_equal(run["linf"], expected["linf"])
    energy = expected["energy"].values[:: expected.attrs["snapshot_every"]]
    np.testing.assert_allclose(run["conserved"][0], energy, rtol=1e-12)
    measured = check(of_model, run)
    assert float(measured["largest_difference"]) < 1e-10
    assert float(measured["conserved_drift"][0]) < 1e-11
    answered = dict(answers.answer_questions(measured, True))
    assert "largest relative change of H" in answered and answered["a localised state"]
    expected_exponent = float(check(paper, expected)["exponent"])
    assert float(measured["exponent"]) == pytest.approx(expected_exponent, abs=0.1)


def test_the_page_on_a_lattice_of_ones_own_has_no_word_of_the_paper(tmp_path):
    model = Model(fields="u", parameters={"c": 1.0}, i_dt=lambda p, u: p.c * u)
    of_model = Case(model=model, half_width=2, initial={0: [1]}, end_time=1)
    paper = Case(omega=-4, half_width=2, end_time=1)
    for case, axis, words in ((of_model, "c", "own equations"), (paper, "omega", "Phys. Lett. A")):
        folder = tmp_path / axis
        mapped = survey(case, {axis: [1, 2]}, keep=["final_l2"], name="map")
        save(folder / "surveys/map.nc", mapped)
        write_table(folder / "surveys/map.nc", folder / "own/tables/surveys/map.csv")
        curves, stem = gather_survey(mapped), folder / "own/surveys/map"
        style.save(draw_survey(curves), curves, *(f"{stem}.{kind}" for kind in KINDS))
        write_report(str(folder / "own.html"), [], {}, {"map": "mine"}, {}, {}, [])
        page = (folder / "own.html").read_text(encoding="utf-8")
        assert words in page and 'href="own/tables/surveys/map.csv"' in page
        assert ("Phys. Lett. A" in page) == (case is paper)


def test_the_page_points_out_sites_that_rest_at_an_unstable_point():
    model = Model(fields="x", parameters={}, d2_dt2=lambda p, x: x - x * x * x)
    case = Case(model=model, half_width=1, initial={0: [0.5]}, end_time=10)
    run = simulate(case)
    for moves in (True, False):
        measured = dict(answers.answer_questions(check(case, run), moves))
        assert measured["sites at rest"].startswith("sites -1, 1 rest at an unstable point")
