"""The README and docs/ say what the committed datasets say, and no number in them is typed.

Three tests hold this together. Each page is what its template gives. A template holds no digit and
no number word outside of an expression, save where a rule below allows it: a name that contains a
digit, or a value that defines what the sentence is about. An expression only names a fact, and a
fact changes with the data.
"""

import re
from pathlib import Path

import numpy as np
import pytest
import render
from facts.baseline import Baseline
from held_digits import blurred, unlike
from pendula.ledger.claim import all_claims
from pendula.report.words import measured
from pendula.studies.pendula.threshold import pendula_threshold

ROOT = Path(__file__).resolve().parents[2]
PAGES = render.pages()

LEFT_OUT = [
    r"```.*?```",  # code: tests run the commands, the YAML and the notebook
    r"^    .*$",  # the equations
    r"`[^`\n]*`",  # names of files, cases and commands
    r"\]\([^)]*\)",  # where a link leads
    r"\{\{.*?\}\}",  # facts
    r"\{%.*?%\}",
    r"<!--.*?-->",
]
NAMES = [
    r"Figs? \d( to \d| and \d)*",
    r"^\| \d(, with \S+)? \|",  # the number of a figure in the table of figures
    r"Lemma \d",
    r"Theorems? \d( to \d)?",
    r"\bl2²?\b",  # a norm
    r"ode45|DOP853",
    r"x86-64|AVX2|AVX-512|netCDF-4",
    r"Python 3\.11",  # the least version, which pyproject.toml says as well
    r"381 \(2017\) 3884|arXiv 1708\.06134",  # where the paper stands
    r"BSD 3-Clause",
]
DEFINITIONS = [
    r"\|A_0\| = 5 \|B_0\|",  # the data of the paper's large cases
    r"l2² = 2 v\* P τ|exp\(-β m⁴/4\)|μ²t/2|μ²t|-H > 0|\(x, 0\)|H\(0\)",  # formulas
    r"3/\(2λ\) ln τ|τ\^\(-1/2\)|\(4 ln N / β\)\^\(1/4\)|\|A_n\|² \+ \|B_n\|²|\(ln τ\)\^\(1/4\)",
    r"Ω = -?\d( and -?\d)?",  # the detuning of a case
    r"\(1 \+ \|n\|\)\^-s|1/2 < s < 1|τ\^\((3/2 - s|1 - s|1/2)\)|C_0 δ",  # more formulas
    r"ε = γ = 1",
    r"A_0|B_0|γ_0",
    r"2γ|4ε",  # the bounds of the unstable band
    r"A = B = 0",
    r"printed 0\.1",  # what the paper prints
    r"from 0 to the end",
]
WORDS = (
    r"\b(three|four|five|six|seven|eight|nine|ten|eleven|twelve|twenty|hundred|thousand|million|"
    r"twice|double|quarter|per cent)\b"
)
ALLOWED_WORDS = [
    r"double precision|double nearest",  # the type of a number
    r"a quarter of a period",  # an instant of a breather
    r"twice the frequency",  # how the chain is driven
]
COUNTED = {
    # counts of rows and words, thresholds, and places in a dataset: no change of a value moves them
    *("ledger", "unbounded.omegas", "unbounded.amplitudes", "references.decimals"),
    *("unbounded.members", "unbounded.neighbours", "unbounded.grown"),
    *("breathers_study.fates.reached", "fates.points", "fates.checked"),
    *(f"breathers.collisions.{name}" for name in ("count", "pairs", "quartets", "omegas")),
    *("breathers.collisions.signatures", "breathers.data_power"),
    *(f"lifetimes.{name}" for name in ("members", "of_paper", "first_fast", "last_fast")),
    *("fates.members", "fates.mixed", "fates.scanned", "fates.terms.0"),
    *("fates.common", "fates.agreed", "fates.stay", "fates.stay_on"),
    *("fates.half_periods", "fates.waves", "fates.within", "fates.periodic.1.unknown"),
    *(
        "speed.processor",
        "pendula_speed.target",
        "speed.faster",
        "speed.fastest_below",
        "theory.cells",
        "theory.decay",
        "second_solver.step",
        "second_solver.least_chance",
        "theory.broken_sites",
        "theory.sites",
    ),
    *(
        "mutation",
        "unbounded.spreading",
        "hard_cases.runs",
        "hard_cases.refused",
        "hard_cases.unexpected",
    ),
    *("chaos.count", "chaos.cases", "solvers.cases", "solvers.diverged", "solvers.kept_early"),
    *("solvers.kept", "solvers.keeping", "ensembles.peak_at", "ensembles.late_from"),
    *("proofs.states", "proofs.stable", "proofs.unstable", "proofs.bits", "proofs.constants"),
    "proofs.chain_sites",
}


def strip(text: str, patterns: list[str]) -> str:
    """Return the text without what the patterns match."""
    for pattern in patterns:
        text = re.sub(pattern, " ", text, flags=re.DOTALL | re.MULTILINE)
    return text


def typed_numbers(text: str) -> list[str]:
    """Return the lines of a template on which a number stands that no rule allows."""
    left = strip(text, [*LEFT_OUT, *DEFINITIONS, *NAMES])
    words = strip(text, [*LEFT_OUT, *ALLOWED_WORDS])
    return [
        *(line.strip() for line in left.splitlines() if re.search(r"[\d½²³⁰¹⁴-⁹₀-₉]", line)),
        *(line.strip() for line in words.splitlines() if re.search(WORDS, line, re.IGNORECASE)),
    ]


@pytest.fixture(scope="module")
def once():
    """Return the baseline, read once."""
    return Baseline(render.BASELINE)


@pytest.fixture(scope="module")
def known(once):
    """Return all facts."""
    return render.known(once)


def test_each_page_is_what_its_template_gives(known):
    given = render.render(known)
    stale = [page.name for page in PAGES if page.read_text(encoding="utf-8") != given[page]]
    assert stale == [], "run `python docs/render.py`"


def test_no_number_is_typed():
    templates = {page.name: PAGES[page].read_text(encoding="utf-8") for page in PAGES}
    assert {
        name: typed_numbers(text) for name, text in templates.items() if typed_numbers(text)
    } == {}


TYPED = [
    "it grows at 1.7 per unit of τ",
    "Fig 3 shows 35 % of them",
    "the power is 10⁻⁶",
    "nine in\nten runs",
    "at Ω = -4 to τ = 400",
    "{{ chaos.count }} of 6 cases",
]


def test_a_typed_number_is_found():
    assert [text for text in TYPED if not typed_numbers(text)] == []


def test_an_expression_only_names_a_fact():
    text = "".join(template.read_text(encoding="utf-8") for template in PAGES.values())
    expressions = re.findall(r"\{\{(.*?)\}\}", text)
    allowed = re.compile(r" [a-z_]\w*(\.[a-z_]\w*)+ ")
    assert expressions and [e for e in expressions if not allowed.fullmatch(e)] == []


def test_every_fact_is_quoted(known):
    text = "".join(template.read_text(encoding="utf-8") for template in PAGES.values())
    named = set(re.findall(r"\b(\w+\.\w+)", text))
    assert [f"{t}.{n}" for t, of in known.items() for n in of if f"{t}.{n}" not in named] == []


class Changed(Baseline):
    """The same datasets with every real number changed by a factor of its own."""

    def __init__(self, once, rng):
        super().__init__(once.folder)
        self.once, self.rng = once, rng

    def __getitem__(self, name):
        if name not in self._read:
            data = self._read[name] = self.once[name].copy(deep=True)
            for variable in data.data_vars.values():
                if variable.dtype.kind == "f":
                    variable.values = variable.values * self._factors(variable.shape)
            for attribute, value in data.attrs.items():
                if isinstance(value, float):
                    data.attrs[attribute] = value * self._factors(())
        return self._read[name]

    def claims(self):
        return [
            {**row, "measured": {name: self._number(v) for name, v in row["measured"].items()}}
            for row in super().claims()
        ]

    def reproduction(self):
        measured = super().reproduction()
        return measured and {**measured, "runs": self._scaled(measured["runs"])}

    def _scaled(self, value):
        if isinstance(value, dict):
            return {key: self._scaled(one) for key, one in value.items()}
        return self._number(float(value))

    def _factors(self, shape):
        """Return a factor for each index of each dimension, so that no mean hides them."""
        factors = self.rng.uniform(1.3, 1.6)
        for axis, size in enumerate(shape):
            along = self.rng.uniform(1.0, 1.6, size)
            factors = factors * along.reshape([-1 if i == axis else 1 for i in range(len(shape))])
        return factors

    def _number(self, value):
        return (value + 1) * self._factors(()) if isinstance(value, float) else value


def flat(known, prefix=""):
    """Return {dotted name: text} of facts; rows of a table are numbered."""
    if isinstance(known, str):
        return {prefix: known}
    items = known.items() if isinstance(known, dict) else enumerate(known)
    found = {}
    for key, value in items:
        found |= flat(value, f"{prefix}.{key}" if prefix else str(key))
    return found


NO_NUMBERS = re.compile(
    r"configured\.|\w+_study\.\w+\.(needed|sizes)|.*\.(case|stated|omega|solver|peer|cases|sites|width|topic)$|"
    r".*(end|from|least_omega|largest_omega|error)$|"
    r"breathers\.(first|last|step|members|weak|strong|scanned|rows\.\d+\.size)$|"
    r"pendula\.(largest_mu|early_mu|late_mu|rows\.\d+\.mu|norms_mu|passages\.\d+\.mu|passing_members)$|"
    r"certified\.((rows|framed)\.\d+\.part|contained|count|until|certificate\..*)$|"
    r"full_run\.(processor|cores|.*\.run)$"
)
"""Facts that are words, sizes or settings, which no change of a value moves."""


def may_be_typed(names: set[str], before: dict[str, str]) -> set[str]:
    """Return those of the facts with these names that should have changed with the data."""
    return {
        name
        for name in names
        if not NO_NUMBERS.match(name)
        and before[name] not in ("never", "none seen", "later", "-", "0 %")
        and not any(name.startswith(counted) for counted in COUNTED)
    }


def test_every_fact_follows_its_dataset(once, known):
    """A number typed into docs/facts would stay when the datasets change."""
    before = flat(known)
    left = may_be_typed(set(before), before)
    assert len(left) > 100
    for seed in range(6):  # a rounded number may be the same by chance, but not each time
        after = flat(render.known(Changed(once, np.random.default_rng(seed))))
        left = {name for name in left if after.get(name) == before[name]}
        if not left:
            break
    assert {name: before[name] for name in sorted(left)} == {}


class Blurred(Baseline):
    """The same datasets with every number moved by half of the last digit that its file holds."""

    def __init__(self, once, rng):
        super().__init__(once.folder)
        self.once, self.rng = once, rng

    def __getitem__(self, name):
        if name not in self._read:
            self._read[name] = blurred(self.once[name], self.rng)
        return self._read[name]


def test_no_page_prints_a_digit_that_the_file_behind_it_does_not_hold(once, known):
    """Moved by half of their last digit, numbers print alike but for the last printed place."""
    before = flat(known)
    for seed in range(3):
        after = flat(render.known(Blurred(once, np.random.default_rng(seed))))
        moved = {name: (text, after.get(name)) for name, text in before.items()}
        assert {name: pair for name, pair in moved.items() if unlike(*pair)} == {}


def test_the_thresholds_of_the_pendula_are_printed_as_they_are_computed(known):
    """How exact they are is tested in 40 digits (tests/studies/pendula)."""
    rows = known["pendula"]["rows"]
    for side, omega in (("below", -4.0), ("above", 8.0)):
        mus = [float(row["mu"]) for row in rows]
        exact = [measured(pendula_threshold(omega, mu, 1.0), 12) for mu in mus]
        assert [row[side] for row in rows] == exact


@pytest.mark.parametrize(
    ("before", "after", "moved"),
    [
        ("2.00253486633", "2.00253498554", True),
        ("2.0025349", "2.0025350", False),
        ("2.5", "2.49999994", True),
        ("1.97 × 10⁻⁴ to 3", "1.98 × 10⁻⁴ to 3", False),
        ("1.97 × 10⁻⁴ to 3", "1.99 × 10⁻⁴ to 3", True),
        ("12,345 sites", "12,346 sites", False),
        ("over 3", "never", True),
    ],
)
def test_a_digit_that_is_not_held_is_found(before, after, moved):
    assert unlike(before, after) == moved


def test_the_ledger_that_is_quoted_has_the_rows_of_the_code():
    kept = [name for row in Baseline(render.BASELINE).claims() for name in row["names"]]
    assert sorted(kept) == sorted(one.name for one in all_claims()), "run `docs/keep.py results`"


def test_every_link_leads_to_a_file():
    links = []
    for page in [*PAGES, ROOT / "ARCHITECTURE.md"]:
        text = strip(page.read_text(encoding="utf-8"), [r"```.*?```", r"`[^`\n]*`"])
        links += [
            page.parent / link for link in re.findall(r"\]\(([^)#]+)", text) if "://" not in link
        ]
    assert links and [str(link) for link in links if not link.exists()] == []


def test_the_files_that_the_architecture_names_exist():
    """Names with a placeholder, and those of the study that is shown as an example, do not."""
    text = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
    named = re.findall(r"`([\w.-]+/[\w./-]*)`", text)
    places = (ROOT, ROOT / "scripts/pendula")
    assert len(named) > 10
    assert [n for n in named if not any((place / n).exists() for place in places)] == []


def test_the_readme_is_one_page_and_leads_to_every_document():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert len(text.splitlines()) <= 100 and text.count("![") == 3
    for page in PAGES:
        assert page.name == "README.md" or f"(docs/{page.name})" in text


def task_pages() -> list[Path]:
    """Return the pages that the README lists below "To do something"."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    listed = text[text.index("To do something:") : text.index("To know more:")]
    return [ROOT / name for name in re.findall(r"\((docs/\w+\.md)\)", listed)]


@pytest.mark.parametrize("page", task_pages(), ids=lambda page: page.name)
def test_a_page_for_a_task_is_short_and_has_what_a_reader_looks_for(page):
    text = page.read_text(encoding="utf-8")
    headings = re.findall("^## (.*)$", text, re.MULTILINE)
    assert {"Commands", "What you see", "What can go wrong"} <= set(headings)
    assert headings[-1] == "What can go wrong" and len(text.splitlines()) <= 90


def test_the_readme_names_every_figure_and_commands_that_exist():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    figures = {path.stem for path in (ROOT / "tests/baseline/figures").glob("*.png")}
    shown = {f"fig{number}" for number in re.findall(r"^\| (\d)", text, re.MULTILINE)}
    shown |= set(re.findall(r"`(\w+)`", text))
    assert figures <= shown
    rules = [ROOT / "Snakefile", *ROOT.glob("benchmarks/*.smk"), *ROOT.glob("workflow/rules/*.smk")]
    known = "".join(path.read_text(encoding="utf-8") for path in rules)
    texts = "".join(page.read_text(encoding="utf-8") for page in PAGES)
    targets = " ".join(re.findall(r"`(?:\.venv/bin/)?snakemake ([a-z]\w*(?: \w+)*)", texts)).split()
    made = set(re.findall(r"^(?:rule|use rule \w+ as) (\w+)", known, re.MULTILINE))
    made |= figures  # which the Snakefile makes rules of, by its list FIGURES
    assert targets and set(targets) <= made


def test_every_document_has_a_template():
    assert sorted((ROOT / "docs").glob("*.md")) == sorted(set(PAGES) - {ROOT / "README.md"})
