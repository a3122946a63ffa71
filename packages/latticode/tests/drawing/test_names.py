"""Figures of models whose fields, parameters and files have any name that they may have."""

import doctest
from keyword import iskeyword

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from latticode import Case, Model, check, lap, notebook, simulate, survey, sweep
from latticode.drawing import style
from matplotlib.mathtext import MathTextParser
from matplotlib.text import Text


def is_name(text):
    return text.isidentifier() and not text.startswith("_") and not iskeyword(text)


letters = st.characters(exclude_categories=["Cs", "Cc", "Cn"])
likely = st.text(st.sampled_from("uA1_ψ波\u0301·𠀀ﬁ"), min_size=1, max_size=6)
names = st.one_of(likely, st.text(letters, min_size=1, max_size=6)).filter(is_name)
files = st.text(st.sampled_from("a^$ {}%#\\_&~.-"), min_size=1, max_size=8)


def figures_of(fields, parameter, file):
    """Return every figure of a case, of its sweep and of its surveys."""

    def i_dt(p, u, v):
        return lap(u) + 0.5 * v, lap(v) + 0.5 * u

    model = Model(fields=fields, parameters={parameter: 0.5}, i_dt=i_dt, name=file)
    case = Case(model=model, half_width=2, initial={0: [1, 0.5j]}, end_time=1)
    run = simulate(case)
    checks = check(case, run)
    numbers, grid = {parameter: [0.5, 1]}, {parameter: [0.5, 1], "initial.0.1": [1, 2]}
    return [
        notebook.draw_norms(run, checks.assign(divergence_time=0.5)),
        notebook.draw_spacetime(run),
        notebook.draw_breather(checks),
        notebook.draw_sweep(sweep(case, [2, 3], windows=[(0, 1)])),
        notebook.draw_survey(survey(case, numbers, keep=["final_l2"])),
        notebook.draw_survey(survey(case, grid, keep=["final_l2"])),
    ]


@given(names, st.sampled_from(["", "n", "{-12}"]))
@example("u_1", "n")
@example("u_", "n")
@example("𠀀_1", "")
def test_mathtext_takes_every_name(name, site):
    MathTextParser("path").parse(f"$|{style.symbol(name, site)}| + 1$")


@given(files)
@example("a$b$^{.py")
def test_no_formula_begins_in_the_name_of_a_file(file):
    text = style.plain_text(file)
    assert text.replace(r"\$", "") == file.replace("$", "")
    MathTextParser("path").parse(f"{text}: $M = 4$")


@pytest.mark.filterwarnings("ignore:Glyph .* missing from font")
@pytest.mark.parametrize(
    ("fields", "parameter", "file"),
    [
        (["u_1", "u_2"], "c_1", "mine_1.py"),
        (["u_", "u__1"], "c_", "a$b$^{.py"),
        (["psi_left_1", "𠀀"], "波", "%#$\\$"),
    ],
)
def test_all_figures_are_drawn_of_any_names(fields, parameter, file):
    for figure in figures_of(fields, parameter, file):
        figure.draw_without_rendering()


LONG = (["displacement_of_the_left_chain", "psi_2"], "strength_of_the_coupling_of_rows", 9 * "abc_")


@pytest.mark.parametrize("names", [LONG, (["psi_1", "psi_2"], "kappa", "short.py")])
def test_all_text_is_inside_its_figure_and_indices_have_seven_points(names):
    for figure in figures_of(*names):
        figure.draw_without_rendering()
        page, needed = figure.bbox_inches, figure.get_tightbbox()
        assert page.x0 <= needed.x0 and needed.x1 <= page.x1
        for text in figure.findobj(Text):
            has_index = style.INDEX.search(text.get_text())
            assert text.get_fontsize() >= (style.WITH_INDICES if has_index else 7)


def test_what_follows_an_underscore_is_an_index():
    spacetime = figures_of(["u_1", "v"], "c_1", "a$b$.py")[1]
    left, right = (axes.get_title("left") for axes in spacetime.axes[:2])
    assert left == r"$|u_{1,n}|$,  a\$b\$.py: c_1 0.5,  $M = 2$"
    assert right == "$|v_n|$,  $(u_{1,{0}}, v_{0}) = (1, 0+0.5j)$"


def test_names_of_one_letter_are_written_as_before():
    assert doctest.testmod(style).failed == 0
    assert [style.symbol("A"), style.symbol("A", "n"), style.symbol("A", "{0}")] == [
        "A",
        "A_n",
        "A_{0}",
    ]
