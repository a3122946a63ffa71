"""The report on a user's cases and sweeps: figures, results of the checks, and all datasets."""

from pathlib import Path

from latticode.datasets.netcdf import read, save
from markupsafe import Markup
from replication.report.described import dataset, figure
from replication.report.document import PageSection, PageTable, write_page

from . import answers

TITLE = "Cases of your own"
FIGURE_SUFFIXES = ("", ".spacetime", ".breather")


def write_report(
    html: str,
    cases: list[str],
    sweeps: dict[str, str],
    surveys: dict[str, str],
    spectra: dict[str, str],
    sections: dict[str, str],
    files: list[str],
) -> None:
    """Write the page `html` on the user's cases, sweeps, surveys, spectra and sections.

    All but `cases` map a name to its case. `files` are all files, below the folder of the page.
    """
    folder, written = Path(html).parent, set(files)
    page = [_case(name, folder, written) for name in cases]
    page += [_many_runs("sweep", name, case, folder) for name, case in sweeps.items()]
    page += [_many_runs("survey", name, case, folder) for name, case in surveys.items()]
    page += [_spectrum(name, case, folder) for name, case in spectra.items()]
    page += [_crossings(name, case, folder) for name, case in sections.items()]
    of_kind = {"trajectories": cases, "sweeps": sweeps, "surveys": surveys}
    of_kind |= {"spectra": spectra, "sections": sections}
    runs = [read(folder / f"{kind}/{name}.nc") for kind in of_kind for name in of_kind[kind]]
    papers = any("model_text" not in run.attrs for run in runs)
    write_page(html, "own.html.j2", TITLE, page, Path(__file__).parent, papers=papers)


def write_table(data: str, table: str) -> None:
    """Write the norms of a dataset, or the quantities of a survey, as CSV."""
    save(table, read(data))


def _table(path: str, folder: Path) -> list[str]:
    """Return a line with a link to the table of a dataset, or no line if there is no table."""
    link = f"own/tables/{Path(path).with_suffix('.csv')}"
    line = Markup('The numbers as CSV: <a href="{0}">{0}</a>').format(link)
    return [line] if (folder / link).exists() else []


def _case(name: str, folder: Path, written: set[str]) -> PageSection:
    run, checks = folder / f"trajectories/{name}.nc", folder / f"own/cases/{name}.checks.nc"
    drawn = [folder / f"own/cases/{name}{suffix}.nc" for suffix in FIGURE_SUFFIXES]
    answered = answers.answer_questions(read(checks), moves=bool(read(run)["linf"].any()))
    return PageSection(
        f"case-{name}",
        f"The case {name}",
        lines=_table(f"trajectories/{name}.nc", folder),
        tables=[PageTable("Results of the checks", ("question", "answer"), answered)],
        figures=[figure(path, folder) for path in drawn if str(path) in written],
        datasets={"Datasets": [dataset(run, folder), dataset(checks, folder)]},
    )


def _many_runs(kind: str, name: str, case: str, folder: Path) -> PageSection:
    """Return the section of a sweep or a survey."""
    file = f"{kind}s/{name}.nc"
    return PageSection(
        f"{kind}-{name}",
        f"The {kind} {name} of the case {case}",
        lines=_table(file, folder),
        figures=[figure(folder / f"own/{file}", folder)],
        datasets={"Datasets": [dataset(folder / file, folder)]},
    )


def _spectrum(name: str, case: str, folder: Path) -> PageSection:
    """Return the section of Lyapunov exponents."""
    file = folder / f"spectra/{name}.nc"
    spectrum = read(file)
    rates, errors = spectrum["exponent"].values, spectrum["exponent_error"].values
    pairs = enumerate(zip(rates, errors, strict=True), 1)
    rows = [(f"{number}", f"{rate:.5g}", f"{error:.2g}") for number, (rate, error) in pairs]
    head = ("number", "exponent per unit of τ", "standard error")
    return PageSection(
        f"spectrum-{name}",
        f"The Lyapunov exponents {name} of the case {case}",
        tables=[PageTable("The largest exponents", head, rows)],
        datasets={"Datasets": [dataset(file, folder)]},
    )


def _crossings(name: str, case: str, folder: Path) -> PageSection:
    """Return the section of the page on a section of a motion."""
    file = folder / f"sections/{name}.nc"
    times = read(file)["crossing_tau"].values
    between = f", from τ = {times[0]:.6g} to {times[-1]:.6g}" if times.size else ""
    return PageSection(
        f"section-{name}",
        f"The section {name} of the case {case}",
        lines=[f"Number of crossings: {times.size}{between}."],
        datasets={"Datasets": [dataset(file, folder)]},
    )
