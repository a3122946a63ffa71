"""Docstrings of the library as Markdown: examples in fences, arguments and variables in lists."""

import re

import griffe

EXAMPLE = re.compile(r"^>>> .*(?:\n(?!\n).*)*", re.MULTILINE)
ENTRY = re.compile(r"^([a-z]\w*(?:, \w+)*(?: \([\w, ]*\))?): ", re.MULTILINE)
FIRST_ENTRY = re.compile(r"^((?!- |    ).+)\n(?=- `)", re.MULTILINE)
"""The sentence above a list; Markdown requires a blank line below it."""


def as_markdown(text: str) -> str:
    """Return a docstring with its examples as code, and each line `name: text` as a list entry."""
    text = ENTRY.sub(r"- `\1`: ", text)
    text = FIRST_ENTRY.sub(r"\1\n\n", text)
    return EXAMPLE.sub(lambda example: f"```pycon\n{example[0]}\n```", text)


class PlainDocstrings(griffe.Extension):
    """An extension of griffe that converts each docstring to Markdown."""

    def on_instance(self, *, obj: griffe.Object, **kwargs) -> None:
        """Convert the docstring of a module, class or function."""
        if obj.docstring:
            obj.docstring.value = as_markdown(obj.docstring.value)
