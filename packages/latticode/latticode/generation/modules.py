"""Kernels of a traced model, generated as the text of a module: rates and power series.

The text depends only on the model and on which of its parameters have a value for each site. The
kernel cache contains the text, and the compiled kernels in a folder named by a hash of the text.
"""

import linecache
import sys
from collections.abc import Callable
from functools import cache
from types import ModuleType

from latticode.equations.graph import Node, switches
from latticode.equations.model import Model
from latticode.kernels.cache import keep_source

from . import toolbox
from .batches import REACH
from .rate_rules import ExactRule, densities_text, rates_text, rule_text, tangents_text
from .series_graph import with_carried
from .series_rules import SeriesWriter
from .statements import ModelInputs, Names, affine, inputs_of

HEAD = f"from {toolbox.__name__} import *\n"
OF_BATCHES = """
from latticode.generation.batches import in_waves, left_neighbours, right_neighbours
"""
"""Follows HEAD and replaces three of its names, so that the same text of a rule continues the
series of a batch."""
BATCHES = """
from latticode.generation import batches
from latticode.simulation import observables
@inlined_by_llvm
def with_constants(system, constants):
    values = ({values})
    others = system.at, system.wide, system.sums, system.couplings, system.left, system.right
    return System(values, system.clocks, *others)
solve = batches.build(continue_in_waves, with_constants, observables.{observe})
@kernel
def run_batch(system, batch, times, controls, memory, record, stop):
    return solve(system, batch, times, controls, memory, record, stop)
"""
AT_TIME = """
@kernel
def at_time(system, t):
{now}
    clocks = ({values})
    others = system.at, system.wide, system.sums, system.couplings, system.left, system.right
    return System(system.constants, clocks, *others)
"""
CLOCKS = """
@in_one_pass
def write_clocks(system, series):
    m, d = series.memory, spare_start(series)
{series}
@kernel
def continue_series(system, series):
    write_clocks(system, series)
    continue_in_waves(system, series)
"""
CLOCK_SERIES = """\
    value, slope = system.clocks[{value}], system.clocks[{slope}]
    square = {speed} * {speed}
    for k in range(ORDER + 1):
        m[d + {value} * (ORDER + 1) + k] = value
        share = 1.0 / (k + 1)
        value, slope = share * slope, -(share * square * value)"""


@cache
def inputs_of_rates(rates: tuple[Node, ...], site_dependent: frozenset[str]) -> ModelInputs:
    """Return the constants, clocks and couplings of the rates and of their series."""
    # if a leaf replaces a function, a sign may move out of a constant: -p.k / (1 + x * x)
    with_leaves, _, carried_rates = with_carried(list(rates), site_dependent)
    carried = (expression for pair in carried_rates for expression in pair)
    return inputs_of([*rates, *with_leaves, *carried], site_dependent)


def at_time_text(inputs: ModelInputs, names: Names) -> str:
    """Return the text of `at_time`, which returns the system with its clocks at time t."""
    now, count = [], len(inputs.clocks)
    for i, clock in enumerate(inputs.clocks):
        value = "t, 1.0"
        if clock.operation != "time":
            speed, phase = map(names.constant, affine(clock.operands[0]))
            now.append(f"    sine, cosine = sine_and_cosine({speed} * t + {phase})")
            pairs = {"sin": f"sine, {speed} * cosine", "cos": f"cosine, -({speed} * sine)"}
            value = pairs[clock.operation]
        now.append(f"    k{i}, l{i} = {value}")
    values = "".join(f"{x}{i}, " for x in "kl" for i in range(count))
    return AT_TIME.format(now="\n".join(now), values=values)


def clocks_text(inputs: ModelInputs, names: Names) -> str:
    """Return the text of `continue_series`, which also writes the power series of the clocks."""
    series, count = [], len(inputs.clocks)
    for i, clock in enumerate(inputs.clocks):
        speed = "0.0"
        if clock.operation != "time":
            speed = names.constant(affine(clock.operands[0])[0])
        series.append(CLOCK_SERIES.format(value=i, slope=count + i, speed=speed))
    return CLOCKS.format(series="\n".join(series) or "    pass")


def module_text(rates: tuple[Node, ...], reach: int, site_dependent: frozenset[str]) -> str:
    """Return the text of the module with these rates and their power series."""
    inputs = inputs_of_rates(rates, site_dependent)
    names = Names(inputs)
    texts = [HEAD, rates_text(rates, names, reach), at_time_text(inputs, names)]
    if not switches(rates):  # a rate that switches has no power series
        texts[2:2] = [SeriesWriter(rates, names, site_dependent).text(reach)]
        texts.append(clocks_text(inputs, names))
    return "".join(texts)


def batches_text(rates: tuple[Node, ...], site_dependent: frozenset[str], observe: str) -> str:
    """Return the text of the module with `run_batch` and `WORK` for batches of runs.

    `observe` names the function that stores the observables of a run. The rates do not depend on
    time, and read neighbours up to `batches.REACH`.
    """
    inputs = inputs_of_rates(rates, site_dependent)
    rule = SeriesWriter(rates, Names(inputs), site_dependent).text(REACH)
    values = "".join(f"load(constants, {i} * LANES), " for i in range(len(inputs.constants)))
    return HEAD + OF_BATCHES + rule + BATCHES.format(values=values, observe=observe)


def tangents_module_text(tangent: Model, site_dependent: frozenset[str]) -> str:
    """Return the text of the module with the rates of a solution and its tangent vectors."""
    inputs = inputs_of_rates(tangent.rates, site_dependent)
    names = Names(inputs)
    return "".join([HEAD, tangents_text(tangent, names), at_time_text(inputs, names)])


def conserved_text(model: Model, site_dependent: frozenset[str], observe: str) -> str:
    """Return the text of a function that calls the one named `observe`, then stores the sums."""
    densities = tuple(model.conserved.values())
    names = Names(inputs_of(densities, site_dependent))
    return densities_text(densities, names, model.reach_of_densities, len(model.fields), observe)


def load_series(model: Model, in_batch: bool = False) -> ModuleType:
    """Return the module for the series of two exchangeable fields: `continue_in_waves` and `WORK`.

    Its system is a named tuple of the model's parameters and clocks. The caller must store the
    coefficients of the clocks one after another from the index `spare_start` on. With `in_batch`
    the functions continue the series of a batch, and the parameters are vectors.
    """
    names = Names(inputs_of_rates(model.rates, frozenset()), by_name=True)
    rule = SeriesWriter(model.rates, names, frozenset(), exchangeable=True).text(model.reach)
    return load_text(HEAD + OF_BATCHES * in_batch + rule)


def load_rule(rates: tuple[Node, ...], *states: str) -> Callable:
    """Compile `rule_text` and return its function rates_at_site(system, states, re, j, dy)."""
    return load_text(HEAD + rule_text(rates, states)).rates_at_site


def load_function(nodes: tuple[Node, ...]) -> Callable:
    """Return a Python function (system, seen) that computes the values of nodes.

    seen(field, part, by) returns part 0 or 1 of a field at the site n + `by`, as a number, an array
    or an expression, so no factor is set to zero. `system` has the parameters as attributes.
    """
    rule = ExactRule(Names(inputs_of(nodes, frozenset()), by_name=True), "seen({}, {}, {})".format)
    values = ", ".join(map(rule.value, nodes))
    namespace: dict[str, Callable] = {}
    lines = ["def function(system, seen):", *rule.code.lines, f"    return {values}"]
    exec("\n".join(lines), namespace)
    return namespace["function"]


@cache
def load_text(text: str) -> ModuleType:
    """Return the module with this text, which is saved to a file because its kernels are cached.

    numba loads a cached kernel only if it can import the kernel's module. The module's name
    therefore depends only on its text.
    """
    file = keep_source("model.py", text)
    module = ModuleType(f"latticode_model_{file.parent.name}")
    linecache.cache[str(file)] = len(text), None, text.splitlines(keepends=True), str(file)
    sys.modules[module.__name__] = module
    exec(compile(text, str(file), "exec"), module.__dict__)
    return module
