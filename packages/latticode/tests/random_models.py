"""Models of the whole grammar that docs/equations.md allows, drawn by the number of a seed.

A model is a text, as a user would write it, so that it is run by the library and by NumPy alike.
"""

import re
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from latticode import Case, Model
from numpy_lattice import slope_of, solution, traced

ENDS = ("dirichlet", "free", "periodic", "antiperiodic")
FARTHEST = 7
"""How far an equation may look."""
PARAMETERS = {"g": 0.7, "w": 1.3}


@dataclass(frozen=True)
class Drawn:
    """A model, a chain and data on it, until `end_time`."""

    text: str
    fields: tuple[str, ...]
    form: str  # the name of the function that gives its equations
    parameters: dict
    boundary: str
    sites: range
    start: np.ndarray  # complex, (field, site): real of dt, with imaginary velocities of d2_dt2
    end_time: float = 1.0

    def __str__(self):
        return f"{self.text}\n{self.boundary}, sites {self.sites}"

    @cached_property
    def case(self):
        """The case of the library."""
        names = traced(self.text)
        functions = {self.form: names[self.form]}
        model = Model(fields=self.fields, parameters=self.parameters, **functions)
        first, last = self.sites[0], self.sites[-1]
        length = {"sites": last + 1} if first == 0 else {"half_width": last}
        return Case(
            model=model,
            **length,
            boundary=self.boundary,
            initial=dict(zip(self.sites, self.start.T.tolist(), strict=True)),
            end_time=self.end_time,
        )

    def follow(self, perturbation=0.0):
        """Return the state at the end, laid out as `start`, by NumPy and SciPy alone."""
        arguments = self.text, self.parameters, self.boundary, len(self.fields), self.form
        start = self.start + perturbation
        flat = {"i_dt": start, "dt": start.real, "d2_dt2": np.array([start.real, start.imag])}
        end = solution(slope_of(*arguments), flat[self.form].ravel(), self.end_time)
        if end is None or self.form != "d2_dt2":
            return end if end is None else end.reshape(start.shape)
        values, velocities = end.reshape(2, *start.shape)
        return values + 1j * velocities


class Grammar:
    """Draws expressions; `reach` is how far along the chain they may look."""

    def __init__(self, rng, fields, complex_fields, driven, disordered):
        self.rng, self.fields, self.complex_fields = rng, fields, complex_fields
        self.numbers = [
            "p.g",
            *["p.V"] * disordered,
            *["cos(p.w * p.t + 0.3)", "exp(-p.t)"] * driven,
            *["1 / (1 + p.t ** 2)", "sin(p.t * p.t)"] * driven,
            *["sin(p.V * p.t)"] * (driven and disordered),
        ]

    def one_of(self, *choices):
        return choices[self.rng.integers(len(choices))]

    def coefficient(self):
        return f"{self.rng.uniform(0.1, 0.6) * self.one_of(-1, 1):.2f}"

    def moved(self, draw, depth, reach):
        """Return an expression that is shifted, by no site in some cases."""
        by = int(self.rng.integers(-reach, reach + 1))
        text = draw(depth, reach - abs(by))
        if abs(by) == 1 and self.rng.integers(2):
            return f"({text}).{'right' if by > 0 else 'left'}"
        return f"shift({text}, {by:+d})" if by else text

    def field(self, depth, reach):
        return self.one_of(*self.fields)

    def atom(self, depth, reach):
        """Return a real number of a field, or one of no field."""
        if self.rng.random() < 0.2:
            return self.one_of(*self.numbers)
        field = self.moved(self.field, 0, reach)
        return self.one_of(f"{field}.real", f"{field}.imag") if self.complex_fields else field

    def square(self, depth, reach):
        """Return something of a field that is never negative."""
        text = self.moved(self.value, depth, reach)
        return f"abs2({text})"

    def real(self, depth, reach):
        """Return a real expression that is never large, nor outside of a function's domain."""
        if depth == 0:
            return self.atom(0, reach)

        def inner():
            return self.real(depth - 1, reach)

        choices = (
            lambda: f"sin({inner()})",
            lambda: f"cos({inner()})",
            lambda: f"exp({self.coefficient()} * sin({inner()}))",
            lambda: f"exp(-{self.square(depth - 1, reach)})",
            lambda: f"log(1.5 + {self.square(depth - 1, reach)})",
            lambda: f"sqrt(1 + {self.square(depth - 1, reach)})",
            lambda: f"(1 + {self.square(depth - 1, reach)}) ** {self.one_of('1.5', '-2', 'p.g')}",
            lambda: f"{inner()} / (1 + {self.square(depth - 1, reach)})",
            lambda: f"{inner()} / (2 + sin({inner()}))",
            lambda: f"({inner()} - {inner()})",
            lambda: f"{inner()} * {inner()}",
            lambda: f"({inner()}) ** {self.one_of(2, 3)}",
            lambda: self.square(depth - 1, reach),
            lambda: self.moved(self.real, depth - 1, reach) if reach else inner(),
            lambda: f"lap({self.real(depth - 1, reach - 1)})" if reach else inner(),
        )
        return self.one_of(*choices)()

    def value(self, depth, reach):
        """Return an expression as complex as the fields are."""
        if not self.complex_fields:
            return self.real(depth, reach)
        if depth == 0:
            field = self.moved(self.field, 0, reach)
            return self.one_of(field, f"conj({field})", f"{field}.conj()")

        def inner():
            return self.value(depth - 1, reach)

        choices = (
            lambda: f"{self.real(depth - 1, reach)} * {inner()}",
            lambda: f"{self.real(depth, reach)} * {self.moved(self.field, 0, reach)}",
            lambda: f"exp(1j * {self.real(depth - 1, reach)})",
            lambda: f"exp({self.coefficient()} * {inner()})",
            lambda: f"{inner()} / (3 + {inner()})",
            lambda: f"{inner()} / (1 + {self.square(depth - 1, reach)})",
            lambda: f"({inner()}) ** 2",
            lambda: f"({inner()} + 1j * {inner()})",
            lambda: self.moved(self.value, depth - 1, reach) if reach else inner(),
            lambda: f"lap({self.value(depth - 1, reach - 1)})" if reach else inner(),
        )
        return self.one_of(*choices)()

    def coupled(self, reach):
        """Return a term in which a matrix couples all sites."""
        inner = self.value(int(self.rng.integers(2)), reach)
        choices = (
            f"couple(p.W, {inner})",
            f"couple(p.W, couple(p.W, {inner}) + {inner})",
            f"{self.real(1, reach)} * couple(p.W, {inner})",
            f"sin(couple(p.W, {self.real(1, reach)})) * {self.value(0, reach)}",
            f"exp(-abs2({self.real(0, reach)} * couple(p.W, {inner}))) * {inner}",
        )
        return self.one_of(*choices)


def reflected(text):
    """Return an expression with left and right exchanged."""
    exchanged = {".left": ".right", ".right": ".left", ", +": ", -", ", -": ", +"}
    return re.sub(r"\.left|\.right|, [+-](?=\d\))", lambda match: exchanged[match[0]], text)


def drawn(seed, attempt=0):
    """Return the model of a seed, whose solution stays of order one between its ends."""
    rng = np.random.default_rng([seed, attempt])
    kind = rng.choice(["complex", "complex", "phases", "real", "forces", "damped"])
    symmetric, driven, disordered = map(bool, rng.random(3) < (0.3, 0.4, 0.5))
    names = tuple("abc"[: rng.choice([1, 2, 2, 3])])
    form = {"real": "dt", "forces": "d2_dt2", "damped": "d2_dt2"}.get(kind, "i_dt")
    velocities = tuple(f"v{name}" for name in names) if kind == "damped" else ()
    seen = tuple(f"{name}.real" for name in names) if kind == "phases" else names + velocities
    grammar = Grammar(rng, seen, kind == "complex", driven, disordered and not symmetric)
    reach = int(rng.choice([0, 1, 1, 2, 3, FARTHEST]))
    coupled = not symmetric and rng.random() < 0.3

    def rate(name):
        terms = [
            f"{grammar.coefficient()} * {grammar.value(int(rng.choice([0, 1, 2, 2])), reach)}"
            for _ in range(rng.integers(1, 3))
        ]
        if coupled:
            terms.append(f"{grammar.coefficient()} * ({grammar.coupled(reach)})")
        text = " + ".join(terms)
        if symmetric:
            text = f"({text}) + ({reflected(text)})"
        return f"1j * ({text})" if kind == "phases" else f"{text} - {name}"

    arguments = ", ".join(("p", *names, *velocities))
    rates = ",\n        ".join(map(rate, names))
    text = f"def {form}({arguments}):\n    return (\n        {rates},\n    )\n"
    half_width = int(max(reach, 2 * reach * symmetric) + rng.integers(0, 6))
    sites = range(-half_width, half_width + 1)
    if rng.random() < 0.4:
        sites = range(len(sites) + int(rng.integers(2)))
    start = rng.normal(size=(len(names), len(sites), 2)) @ (0.3, 0.3j)
    if kind in ("phases", "real"):
        start = start.real + 0j
    if symmetric:
        start = start + start[:, ::-1]
    parameters = {**PARAMETERS, "V": rng.uniform(-1.0, 1.0, len(sites))}
    if coupled:
        density = 0.2 if rng.random() < 0.5 else 1.0
        matrix = rng.uniform(-1.0, 1.0, (len(sites), len(sites))) / len(sites)
        parameters["W"] = np.where(rng.random(matrix.shape) < density, matrix, 0.0)
    boundary = str(rng.choice(ENDS))
    model = Drawn(text, names, form, parameters, boundary, sites, start)
    return model if model.follow() is not None else drawn(seed, attempt + 1)
