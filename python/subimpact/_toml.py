"""Values and cases as TOML."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any

from ._errors import CaseError

#: Parts of a key, and tables in each other.
DEEPEST = 32

_BARE = re.compile(r"[A-Za-z0-9_-]+\Z")
_STRINGS_AND_COMMENTS = re.compile(
    r'''"""(?:\\.|[^\\])*?(?:"""|\Z)|'{3}.*?(?:'{3}|\Z)|"(?:\\[^\n]|[^"\\\n])*"?|'[^'\n]*'?|\#[^\n]*''',
    re.DOTALL,
)


def text_of(value: Any) -> str:
    """A value of a key, as `_core.checked` returns it, as TOML."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return quoted(value)
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(text_of(item) for item in value) + "]"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{dotted(key)} = {text_of(item)}" for key, item in value.items()) + " }"
    return repr(value)


def quoted(text: str) -> str:
    """A text as a basic string of TOML."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def dotted(key: str) -> str:
    """A key with its table, each part quoted where it has to be."""
    return ".".join(part if _BARE.match(part) else quoted(part) for part in key.split("."))


def has_deep_key(text: str) -> bool:
    """Whether a text of TOML has keys of more than DEEPEST parts, which parsers take in quadratic time."""
    bare = _STRINGS_AND_COMMENTS.sub("x", text)
    return any(part.count(".") > DEEPEST for part in re.split(r"[=,\n\[\]{}]", bare))


def flat(tables: Mapping[str, Any], prefix: str = "", value_with: str = "") -> dict[str, Any]:
    """The values of nested tables by keys with dots; a later one of the same key counts. A table with the key `value_with` is
    a value."""
    if prefix.count(".") > DEEPEST:
        raise CaseError(
            f"tables are nested deeper than {DEEPEST}, in {prefix[:40]}...; allowed: tables of keys, such "
            'as {"beam": {"length": 1}}; is one of them part of itself?'
        )
    values: dict[str, Any] = {}
    for name, value in tables.items():
        if isinstance(value, Mapping) and value_with not in value:
            values.update(flat(value, f"{prefix}{name}.", value_with))
        else:
            values[prefix + str(name)] = value
    return values
