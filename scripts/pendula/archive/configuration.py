"""The configuration of a run as YAML, whole: with it, another run makes the same."""

import yaml


class _Plain(yaml.SafeDumper):
    """Write a value that stands in two places twice, not as an alias."""

    def ignore_aliases(self, data) -> bool:
        """Return True for every value."""
        return True


def dump(configuration: dict) -> bytes:
    """Return the configuration as text, sorted by key."""
    return yaml.dump(_plain(configuration), Dumper=_Plain, allow_unicode=True).encode()


def _plain(value):
    """Return mappings and sequences of any kind as dictionaries and lists."""
    if isinstance(value, dict):
        return {key: _plain(entry) for key, entry in value.items()}
    return [_plain(entry) for entry in value] if isinstance(value, list | tuple) else value
