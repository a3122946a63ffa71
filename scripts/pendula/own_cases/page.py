"""The report on a user's cases and sweeps: figures, what the checks say, and all datasets."""

from pathlib import Path

from latticode.datasets.netcdf import read, save

from pendula.report.described import dataset, figure
from pendula.report.document import Section, Table, write_page
from pendula.report.words import told

from . import answers

TITLE = "Cases of your own"
PARTS = ("", ".spacetime", ".breather")


def write_report(
    html: str,
    cases: list[str],
    sweeps: dict[str, str],
    surveys: dict[str, str],
    files: list[str],
) -> None:
    """Write the page `html` on `cases`, and on `sweeps` and `surveys` with the case of each.

    Their `files` lie below its folder.
    """
    folder, made = Path(html).parent, set(files)
    sections = [_case(name, folder, made) for name in cases]
    sections += [_sweep(name, case, folder) for name, case in sweeps.items()]
    sections += [_survey(name, case, folder) for name, case in surveys.items()]
    made = [
        *(folder / f"trajectories/{name}.nc" for name in cases),
        *(folder / f"sweeps/{name}.nc" for name in sweeps),
        *(folder / f"surveys/{name}.nc" for name in surveys),
    ]
    papers = any("model_text" not in read(path).attrs for path in made)
    write_page(html, "own.html.j2", TITLE, sections, papers=papers)


def write_table(data: str, table: str) -> None:
    """Write the norms of a dataset, or what a survey kept, as CSV."""
    save(table, read(data))


def _table(path: str, folder: Path) -> list[str]:
    """Return a line that leads to the table of a dataset, where there is one."""
    link = f"own/tables/{Path(path).with_suffix('.csv')}"
    text = 'The numbers as CSV: <a href="{link}">{link}</a>'
    return [told(text, link=link)] if (folder / link).exists() else []


def _case(name: str, folder: Path, made: set[str]) -> Section:
    run, checks = folder / f"trajectories/{name}.nc", folder / f"own/cases/{name}.checks.nc"
    drawn = [folder / f"own/cases/{name}{part}.nc" for part in PARTS]
    moves = bool(read(run)["linf"].any())
    return Section(
        f"case-{name}", f"The case {name}",
        lines=_table(f"trajectories/{name}.nc", folder),
        tables=[_answers(answers.of_case(read(checks), moves))],
        figures=[figure(path, folder) for path in drawn if str(path) in made],
        datasets={"Datasets": [dataset(run, folder), dataset(checks, folder)]},
    )  # fmt: skip


def _sweep(name: str, case: str, folder: Path) -> Section:
    swept, drawn, checks = (
        folder / path
        for path in (f"sweeps/{name}.nc", f"own/sweeps/{name}.nc", f"own/sweeps/{name}.checks.nc")
    )
    return Section(
        f"sweep-{name}", f"The sweep {name} over the case {case}",
        lines=_table(f"sweeps/{name}.nc", folder),
        tables=[_answers(answers.of_sweep(read(swept), read(checks)))],
        figures=[figure(drawn, folder)],
        datasets={"Datasets": [dataset(path, folder) for path in (swept, drawn, checks)]},
    )  # fmt: skip


def _survey(name: str, case: str, folder: Path) -> Section:
    made, drawn = folder / f"surveys/{name}.nc", folder / f"own/surveys/{name}.nc"
    return Section(
        f"survey-{name}", f"The survey {name} of the case {case}",
        lines=_table(f"surveys/{name}.nc", folder),
        figures=[figure(drawn, folder)],
        datasets={"Datasets": [dataset(made, folder)]},
    )  # fmt: skip


def _answers(rows: answers.Answers) -> Table:
    return Table("What the checks say", ("question", "answer"), rows)
