"""Tables in Markdown."""

from pendula.report.tables import markdown, write_page


def test_a_table_keeps_its_texts_and_escapes_bars():
    lines = markdown(["case", "|A|"], [["fig2", "1.0e-03"], ["nan", 2.50]]).splitlines()
    assert lines[0] == "| case | \\|A\\| |"
    assert set(lines[1]) == {"|", "-"} and lines[1].count("|") == 3
    assert lines[2:] == ["| fig2 | 1.0e-03 |", "| nan | 2.5 |"]


def test_a_table_without_rows_has_its_head():
    assert markdown(["case", "time"], []).splitlines()[0] == "| case | time |"


def test_a_page_has_empty_lines_between_its_parts(tmp_path):
    write_page(tmp_path / "page.md", "# Title", "Words.", markdown(["a"], [["1"]]))
    assert (tmp_path / "page.md").read_text() == "# Title\n\nWords.\n\n| a |\n|-----|\n| 1 |\n"
