"""Types of values in a configuration: numbers, names, lists without duplicates.

They reject, with a message, what pydantic would silently convert: `true` to 1, or "1 0" to 10.
"""

import math
import re
from typing import Annotated, Any

from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    create_model,
    model_validator,
)
from pydantic_core import PydanticCustomError

NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?|[-+]?\.?(inf|nan)", re.ASCII | re.I)
"""A number as a string: YAML 1.1 reads 1e-7 as a string, because it has no decimal point."""
MOST_DIGITS = 15
"""The most digits of a whole number; longer ones are useless as counts and overflow in datasets."""
LONGEST_SHOWN = 60
"""The most characters of a value in a message, and of a name: file systems limit file names."""


def excerpt_of(value: Any) -> str:
    """Return a value as text for a message: strings in quotes, and long values shortened."""
    if value is None:
        return "empty"
    if isinstance(value, int) and not isinstance(value, bool) and digits(value) > MOST_DIGITS + 3:
        return f"a whole number of {digits(value)} digits"
    text = repr(value) if isinstance(value, str | list | tuple | dict) else str(value)
    return text if len(text) <= LONGEST_SHOWN else f"{text[:LONGEST_SHOWN]}..."


def digits(value: int) -> int:
    """Return the number of decimal digits of a whole number; an estimate if there are thousands."""
    if abs(value).bit_length() < 10_000:
        return len(str(abs(value)))
    return int(abs(value).bit_length() * 0.30103) + 1  # Python does not print such numbers


def fault(text: str) -> PydanticCustomError:
    """Return an error with this text, which pydantic reports at the path of the checked value."""
    return PydanticCustomError("fault", "{text}", {"text": text})


def faults(texts_by_key: list[tuple[str, str]]) -> PydanticCustomError:
    """Return an error that holds pairs (key, text); keys are relative to the checked value."""
    return PydanticCustomError("faults", "{found}", {"found": texts_by_key})


def _require_number(value: Any, kind: str = "a number") -> Any:
    """Return the value unchanged; rejects values that pydantic would convert to a number."""
    if isinstance(value, bool):
        raise fault(f"is {value}, not {kind}")
    if isinstance(value, int) and digits(value) > MOST_DIGITS + 3:
        raise fault(f"is {excerpt_of(value)}, too large to compute with")
    if isinstance(value, str):
        if not NUMBER.fullmatch(value.strip(" ")) or len(value) > LONGEST_SHOWN:
            raise fault(f"is {excerpt_of(value)}, not {kind}")
        return value.strip(" ")
    return value


def as_whole(value: Any) -> Any:
    """Return a string such as "1e6" or "20.0" as a whole number, and any other value unchanged.

    YAML reads 1e6 as a string, but 1.0e6 as a number.
    """
    if isinstance(value, str) and NUMBER.fullmatch(value.strip(" ")):
        number = float(value)
        if number.is_integer() and digits(int(number)) <= MOST_DIGITS:
            return int(number)
    return value


def _countable(value: int) -> int:
    if digits(value) > MOST_DIGITS:
        raise fault(f"is {excerpt_of(value)}, too large to count with")
    return value


def as_complex(value: Any) -> complex:
    """Return 2, 2.0 or "-0.3+0.4j" as a complex number; rejects infinity and NaN."""
    try:
        if isinstance(value, str):
            value = re.sub(r" *([-+]) *", r"\1", value.strip(" "))
        if isinstance(value, bool) or (isinstance(value, str) and "_" in value):
            raise TypeError
        number = complex(value)
    except OverflowError:
        raise fault(f"is {excerpt_of(value)}, too large to compute with") from None
    except (TypeError, ValueError):
        hint = (
            "; the imaginary unit is written j" if re.search(r"\di'?$", excerpt_of(value)) else ""
        )
        text = f'is {excerpt_of(value)}, not a complex number such as "-0.3+0.4j"{hint}'
        raise fault(text) from None
    if not (math.isfinite(number.real) and math.isfinite(number.imag)):
        raise fault(f"is {excerpt_of(value)}, which is not finite")
    return number + 0.0  # no negative zeros


def _distinct(values: list) -> list:
    seen: set = set()
    for value in values:
        if value in seen:
            text = list(value) if isinstance(value, tuple) else value
            raise fault(f"the same value is given twice: {text}")
        seen.add(value)
    return values


def _aperiodic(name: str) -> str:
    if re.search(r"(.+?)\1{19}", name):
        raise fault(
            f"is {excerpt_of(name)}, which repeats a group of letters 20 times; choose another"
            " name: Snakemake takes such a file name for an endless recursion"
        )
    return name


Complex = Annotated[complex, BeforeValidator(as_complex)]
AnyNumber = Annotated[float, BeforeValidator(lambda value: _require_number(value))]
# without negative zeros
Number = Annotated[AnyNumber, AfterValidator(lambda x: x + 0.0), Field(allow_inf_nan=False)]
Positive = Annotated[Number, Field(gt=0)]
Tolerance = Annotated[Positive, Field(ge=1e-15, lt=1)]
Integer = Annotated[
    int,
    BeforeValidator(lambda value: as_whole(_require_number(value, "a whole number"))),
    AfterValidator(_countable),
]
Count = Annotated[Integer, Field(ge=1)]
Natural = Annotated[Integer, Field(ge=0)]
Name = Annotated[
    str,
    Field(pattern=r"^[A-Za-z][A-Za-z0-9_-]*$", max_length=LONGEST_SHOWN),
    AfterValidator(_aperiodic),
]
Distinct = AfterValidator(_distinct)
"""An annotation of the type of a list: rejects duplicate values."""
Numbers = Annotated[list[Number], Field(min_length=1), Distinct]
Positives = Annotated[list[Positive], Field(min_length=1), Distinct]
Counts = Annotated[list[Count], Field(min_length=1), Distinct]
Names = Annotated[list[Name], Field(min_length=1), Distinct]
Window = tuple[Number, Number]


class Section(BaseModel):
    """A mapping of the configuration; rejects unknown keys."""

    # `defer_build`: most sections are only validated as parts of a larger model
    model_config = ConfigDict(extra="forbid", frozen=True, validate_default=True, defer_build=True)


def section_of(**keys: Any) -> type[Section]:
    """Return the pydantic model of a mapping with these required keys, each with its type."""
    return create_model("Mapping", __base__=Section, **{key: (of, ...) for key, of in keys.items()})


class Steps(Section):
    """Equally spaced values, both ends included."""

    first: Number
    last: Number
    step: Positive

    @model_validator(mode="after")
    def _forward(self) -> "Steps":
        if not self.first < self.last:
            raise fault(f"first is {self.first:g}; it must be less than last, {self.last:g}")
        return self

    @property
    def values(self) -> list[float]:
        """The values, each rounded to twelve digits."""
        count = round((self.last - self.first) / self.step)
        return [float(f"{self.first + i * self.step:.12g}") for i in range(count + 1)]
