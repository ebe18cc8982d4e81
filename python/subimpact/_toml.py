"""Values and cases as TOML."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

_BARE = re.compile(r"[A-Za-z0-9_-]+\Z")


def text_of(value: Any) -> str:
    """A value of a key, as `_core.checked` returns it, as TOML."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return quoted(value)
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(text_of(item) for item in value) + "]"
    return repr(value)


def quoted(text: str) -> str:
    """A text as a basic string of TOML."""
    escapes = {'"': '\\"', "\\": "\\\\"}
    return '"' + "".join(
        escapes.get(c) or (f"\\u{ord(c):04x}" if ord(c) < 32 or ord(c) == 127 else c) for c in text
    ) + '"'


def dotted(key: str) -> str:
    """A key with its table, each part quoted where it has to be."""
    return ".".join(part if _BARE.match(part) else quoted(part) for part in key.split("."))


def flat(tables: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """The values of nested tables by keys with dots; a later one of the same key counts."""
    values: dict[str, Any] = {}
    for name, value in tables.items():
        if isinstance(value, Mapping):
            values.update(flat(value, f"{prefix}{name}."))
        else:
            values[prefix + str(name)] = value
    return values
