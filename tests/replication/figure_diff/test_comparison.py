"""What decides: environment, bits, chaos; missing and extra files; the page and the last lines."""

import json

import made_up_results as made_up
import numpy as np
import pytest
from latticode.datasets.json_files import load_json
from latticode.datasets.netcdf import read
from latticode.drawing.seals import sealed_pdf
from made_up_results import CHAOTIC, CONFIGURATION, HORIZON, LEDGER, NAMES, PICTURE, REGULAR, REPORT
from replication.figure_diff import Status, baseline
from replication.figure_diff.acceptance import AcceptanceError
from replication.figure_diff.chaos import LOCAL, MARGIN, TOLERANCE, Chaos, known_chaos
from replication.figure_diff.compare_pictures import damage, edited
from replication.figure_diff.compare_shown import comparable, compare, hash_of
from replication.figure_diff.comparison_page import compare_results


def nudge(data):
    """Return a dataset that differs by less than the tolerance."""
    return data.assign(l2=data["l2"] * (1 + 1e-9))


def test_another_right_run_is_refused_with_the_accepted_bits_alone(moved_run):
    """Chaos takes another path in it, in all that rests on it; nothing else moves."""
    strictly, comparison = moved_run.judge(), moved_run.judge(any_bits=True)
    assert strictly.counts.keys() == {Status.DIFFERENT, Status.IDENTICAL}
    kinds = {Status.BEYOND, Status.WITHIN, Status.IDENTICAL}
    assert not comparison.faults and comparison.counts.keys() == kinds
    moved = {each.name for each in comparison.findings if each.status == Status.BEYOND}
    assert {CHAOTIC, made_up.SWEEP, made_up.MAP, LEDGER, REPORT, "figures/fig4.png"} < moved
    assert not any("fig2" in name for name in moved)
    assert comparison.lines[-1].endswith("were not compared: they may be right or wrong")


@pytest.mark.parametrize(
    ("package", "status"),
    [("data.numpy", Status.WITHIN), ("drawing.matplotlib", Status.DIFFERENT)],
)
def test_another_environment_compares_numbers_where_it_decides_them(run, package, status):
    run.change(REGULAR, nudge)
    run.pretend(*package.split("."))
    assert f"{package} is " in run.judge().judged and run.findings()[REGULAR].status == status


def test_pictures_of_other_versions_are_judged_by_their_descriptions(run):
    pdf = run.made / "figures/fig2.pdf"
    pdf.write_bytes(sealed_pdf(pdf.read_bytes()))
    run.pretend("drawing", "zlib")
    finding = run.findings()["figures/fig2.pdf"]
    assert finding.status == Status.BEYOND and "its description is identical" in finding.reason


def test_other_versions_of_drawing_may_choose_other_ticks_and_no_other_words(run):
    description = "figures/fig2.json"
    run.pretend("drawing", "matplotlib")
    run.edit(description, '"ticks": ["0", "2"', '"ticks": ["0", "1", "2"')
    assert run.findings()[description].status == Status.BEYOND
    run.edit(description, "some case", "no case")
    assert run.findings()[description].status == Status.DIFFERENT


def test_words_of_a_text_may_follow_no_number_and_numbers_only_what_moved(run, moved):
    run.change(REGULAR, nudge)
    made_up.put_words(run.made, largest=6.60404)  # a last digit follows
    assert run.findings(any_bits=True)[LEDGER].status == Status.WITHIN
    made_up.put_words(run.made, largest=6.70403)  # nothing that moved is so large
    assert run.findings(any_bits=True)[LEDGER].status == Status.DIFFERENT
    made_up.put_words(moved.made, largest=6.9, verdict="not reproduced")
    results = moved.findings(any_bits=True)
    assert results[LEDGER].status == Status.DIFFERENT and "not reproduced" in results[LEDGER].reason


@pytest.mark.parametrize(
    ("was", "now", "status"),
    [
        ({"points": 1, "x": [9.0, 9.0], "y": [100.0, 100.0]}, {"points": 0}, Status.BEYOND),
        ({"points": 0}, {"points": 2, "x": [8.0, 9.0], "y": [100.0, 100.0]}, Status.BEYOND),
        ({"points": 8, "shows": "life"}, {"points": 8}, Status.DIFFERENT),
        ({"points": 8, "shows": "life"}, {"points": 8, "shows": "end"}, Status.DIFFERENT),
    ],
)
def test_a_curve_of_chaotic_numbers_may_lose_all_points_and_not_what_it_shows(
    was, now, status, tmp_path
):
    text, described = tmp_path / "figure.json", [{"panels": [{"curves": [c]}]} for c in (was, now)]
    text.write_text(json.dumps(described[1]))
    chaotic = {"": Status.BEYOND}
    assert compare(text, json.dumps(described[0]), chaotic)[0] == status


def test_times_of_a_machine_are_no_part_of_the_report(run):
    run.edit(REPORT, "96 s", "77 s")
    assert run.findings()[REPORT].status == Status.IDENTICAL


def test_only_jobs_and_numbers_are_left_out_of_what_is_of_the_machine():
    row = '<tr><th scope="row">{}</th><td>{}</td><td>90</td></tr>\n'
    page = '<section id="run">\n<caption>Times: {} s in all</caption>\n{}</section>'
    jobs = row.format("sweeps/fig5_left", 9.5) + row.format("live", 3.0)
    first, slower, forged = (
        comparable("report.html", text.encode())
        for text in (
            page.format(13, jobs),
            page.format(20, row.format("live", 20.0)),
            page.format(13, jobs + row.format("all claims are refuted", 1)),
        )
    )
    assert first == slower != forged
    twice = 2 * page.format(13, jobs).encode()
    assert comparable("report.html", twice) == twice


# Which numbers rest on chaos


def test_the_horizon_is_that_of_roundings_alone_and_sweeps_have_none(run):
    known = known_chaos(run.accepted, CONFIGURATION, made_up.TRUSTED)
    assert known.horizons.keys() == {"fig4_small", "fig5_right"}
    assert known.horizons["fig4_small"] == pytest.approx(HORIZON, abs=0.2)
    assert known.horizons["fig5_right"] == -np.inf
    assert known._regular_values("omega") == {8.0}


def test_a_number_is_the_less_known_the_later_it_is_after_the_horizon(run):
    """The made-up errors grow tenfold in a unit of time."""
    chaos, data = (
        known_chaos(run.accepted, CONFIGURATION, made_up.TRUSTED),
        read(run.made / CHAOTIC),
    )
    freedom = chaos.freedom(CHAOTIC, "l2", data)[0]
    horizon, tau = chaos.horizons["fig4_small"], data["tau"].values
    assert not freedom[tau < horizon].any() and np.isinf(freedom[tau > HORIZON + 6.0]).all()
    later = np.searchsorted(tau, HORIZON + 3.0)
    assert freedom[later] == pytest.approx(LOCAL * 1e3 * TOLERANCE, rel=0.01) and MARGIN < 1.0


@pytest.mark.parametrize(
    ("name", "variable", "expected"),
    [
        ("trajectories/fig4_small", "l2", 0.818),  # by the file, after the horizon
        ("trajectories/fig2_small", "l2", 0.0),
        ("trajectories/fig4_large", "l2", 0.0),
        ("checks/lyapunov", "exponent", 0.5),  # by the words along a dimension, without a time
        ("checks/trust", "difference", 0.5),  # divided by the largest of the tail
        ("trajectories/fig4_small", "tau", 0.0),
    ],
)
def test_what_rests_on_chaos(run, name, variable, expected):
    files = {"exponent": made_up.EXPONENTS, "difference": made_up.TRUST}
    data = read(run.made / files.get(variable, REGULAR))
    chaos = Chaos({"fig4_small": HORIZON}, time="tau")
    rests = chaos.freedom(f"{name}.nc", variable, data) > 0.0
    assert rests.mean() == pytest.approx(expected, abs=0.003)


def declared(data, **attributes):
    return data.assign(l2=data["l2"].assign_attrs(attributes))


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        ("no", 0.0),
        ("yes", 1.0),
        ("by case", 0.818),
        ("by case at all times", 1.0),
        ("along omega", 1.0),  # which is no dimension of the norms
    ],
)
def test_a_variable_says_whether_it_rests_on_chaos(run, value, expected):
    data = declared(read(run.made / CHAOTIC), rests_on_chaos=value)
    rests = Chaos({"fig4_small": HORIZON}, time="tau").freedom(CHAOTIC, "l2", data) > 0.0
    assert rests.mean() == pytest.approx(expected, abs=0.003)


def test_a_variable_that_says_nothing_of_chaos_is_neither_compared_nor_accepted(run):
    data = read(run.made / CHAOTIC)
    chaos = Chaos({}, cases=CONFIGURATION["cases"], time="tau")
    assert chaos.undeclared(CHAOTIC, data) == []  # its name is that of a case
    assert chaos.undeclared("waves/lives.nc", data) == ["l2", "bound"]
    assert chaos.undeclared("waves/lives.nc", declared(data, rests_on_chaos="no")) == ["bound"]
    run.change(made_up.LIVES, lambda lives: (lives + 1.0).drop_attrs())
    finding = run.findings(any_bits=True)[made_up.LIVES]
    assert finding.status == Status.DIFFERENT
    assert finding.reason.startswith("median does not declare whether it rests on chaos")
    assert 'set the attribute rests_on_chaos = "no" or "yes"' in finding.reason
    with pytest.raises(AcceptanceError, match=r"checks/lifetimes.nc, median does not declare"):
        run.accept()


# Files, and what is written


def test_missing_and_extra_files_and_another_configuration_are_named(run):
    names = [*(name for name in NAMES if name != PICTURE), "checks/new.nc"]
    (run.made / "checks/new.nc").write_bytes((run.made / REGULAR).read_bytes())
    lines = run.judge(names).lines
    assert f"missing: {PICTURE}: is in the baseline, but no longer among the results" in lines
    assert "extra: checks/new.nc: is not in the baseline" in lines
    cases = CONFIGURATION["cases"] | {"fig2_small": {"end_time": 4, "omega": 8}}
    shorter = CONFIGURATION | {"cases": cases}
    fault = baseline.compare(NAMES, *run, shorter).findings[0]
    reason = "is not the accepted one: cases.fig2_small.end_time is 4 in place of 50"
    assert fault == ("configuration", "different", reason)


def test_without_a_baseline_all_is_extra(run, tmp_path):
    verdict = run._replace(accepted=tmp_path / "nothing").judge()
    assert verdict.counts == {Status.EXTRA: len(NAMES)} and verdict.faults == len(NAMES)


def test_the_page_shows_findings_and_both_pictures_and_needs_no_network(run, monkeypatch):
    monkeypatch.chdir(run.made.parent)
    made_up.put(run.made, "fig2", made_up.norms(False), label="norm")
    results = [f"results/{name}" for name in NAMES]
    arguments = results, "results", str(run.accepted), CONFIGURATION, False
    compare_results(*arguments, "diff/index.html", "diff/verdict.json")
    page = (run.made.parent / "diff/index.html").read_text()
    verdict, same = load_json("diff/verdict.json"), len(NAMES) - 3
    assert verdict["faults"] == 3 and verdict["counts"] == {"different": 3, "identical": same}
    assert len(verdict["lines"]) == 5
    assert verdict["lines"][-1] == f"3 different, {same} identical"
    assert "Figure diff: 3 faults" in page and "figures/fig2.json" in page
    assert page.count('src="data:image/png;base64,') == 2
    assert "://" not in page and str(run.made) not in page


def test_a_flipped_bit_anywhere_in_a_png_is_damage(accepted_run):
    path = accepted_run.made / PICTURE
    content = path.read_bytes()
    assert not damage(path, content) and not edited(path, content)
    for place in range(0, len(content) - 12, 97):
        flipped = bytearray(content)
        flipped[place] ^= 1
        assert damage(path, bytes(flipped)) or edited(path, bytes(flipped)), place


def test_other_code_of_the_same_results_leaves_the_article_as_it_is():
    card = b'<div class="card" id="code_a.b"><p>a.b</p><pre>%s</pre></div>'
    pages = [b"<p>2 (1 to 3)</p>" + card % code for code in (b"x = 1", b"x = 1  # why")]
    first, second = (hash_of("article.html", page) for page in pages)
    assert first == second
    assert first != hash_of("article.html", pages[0].replace(b"2 (1", b"2 (0"))
