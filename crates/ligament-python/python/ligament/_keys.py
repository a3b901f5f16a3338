"""The keys of a case, from the schema of the program."""

from __future__ import annotations

import difflib
import functools
import html
import json
import re
import textwrap
from dataclasses import dataclass
from typing import Any

from ligament import _native
from ligament._errors import LigamentError

Schema = dict[str, Any]

# Width of the texts of keys in a console, characters.
WIDTH = 110


@dataclass(frozen=True)
class Key:
    """A key of a case: its path, the kind of its value, SI unit, default, the words that it may be, and what it means."""

    path: str
    kind: str
    unit: str | None
    default: Any
    words: tuple[str, ...]
    meaning: str

    def __repr__(self) -> str:
        told = [self.kind] + [f"in {self.unit}"] * bool(self.unit) + [f"default {self.default}"] * (self.default is not None)
        lines = [line for part in self.meaning.split("\n") for line in textwrap.wrap(part, WIDTH) or [""]]
        return "\n".join([f"{self.path}: {', '.join(told)}", *(f"    {line}" for line in lines)])


class Keys(list[Key]):
    """Keys, which notebooks and consoles show as a table."""

    def __repr__(self) -> str:
        return "\n".join(map(repr, self))

    def _repr_html_(self) -> str:
        rows = ""
        for key in self:
            cells = (key.path, key.kind, key.unit or "", "" if key.default is None else str(key.default), key.meaning)
            rows += "<tr>" + "".join(f"<td style='text-align:left'>{html.escape(it)}</td>" for it in cells) + "</tr>"
        heads = "".join(f"<th>{it}</th>" for it in ("key", "value", "unit", "default", "meaning"))
        return f"<table><tr>{heads}</tr>{rows}</table>"


def keys(path: str = "") -> Keys:
    """The keys below a path such as ``"fracture.criterion"``, or the one key at it, with units, defaults, words and meanings; at first sections.

    >>> keys("material.young")
    material.young: number, in Pa
        Young's modulus, Pa.
    """
    schema = _schema()
    place: list[str] = []
    for part in filter(None, path.replace("__", ".").split(".")):
        found = _tables(schema)
        below = {name: it for table in found for name, it in table.get("properties", {}).items()}
        named = next((it["additionalProperties"] for it in found if isinstance(it.get("additionalProperties"), dict)), None)
        if part.isdigit() or (part not in below and named):
            # An entry of a list, or of a table by names of the user.
            schema = schema if part.isdigit() else named or schema
        elif part in below:
            schema = below[part]
        else:
            where = ".".join(place) or "a case"
            near = difflib.get_close_matches(part, below, 1)
            hint = (f"did you mean `{near[0]}`? " if near else "") + f"keys: {', '.join(below)}"
            raise LigamentError(f"{where} has no key `{part}`; {hint}", key=path, hint=hint)
        place.append(part)
    found = _tables(schema)
    below = {name: it for table in found for name, it in table.get("properties", {}).items()}
    if not below:
        return Keys([_key(".".join(place), schema)])
    return Keys(_key(".".join([*place, name]), it) for name, it in below.items())


@functools.cache
def _schema() -> Schema:
    schema: Schema = json.loads(_native.schema())
    return schema


def _tables(schema: Schema) -> list[Schema]:
    """The tables among the forms of a value, or of the entries of a list."""
    forms = schema.get("anyOf", []) if "type" not in schema else []
    return [it for form in (schema, schema.get("items", {}), *forms) for it in [form] if "properties" in it or "additionalProperties" in it]


def _key(path: str, schema: Schema) -> Key:
    words = schema.get("enum", [])
    meaning = str(schema.get("description") or schema.get("items", {}).get("description", ""))
    # Lines of a paragraph are broken where the source breaks them.
    meaning = re.sub(r"\n+(?=- )", "\n", re.sub(r"(?<!\n)\n(?![\n-])", " ", meaning))
    return Key(path, _kind(schema), schema.get("x-unit"), schema.get("default"), tuple(map(str, words)), meaning)


def _kind(schema: Schema) -> str:
    """What the value of a key is, in words."""
    if "enum" in schema:
        return "one of " + ", ".join(f'"{it}"' for it in schema["enum"])
    if "const" in schema:
        return f'"{schema["const"]}"'
    if "anyOf" in schema and "type" not in schema:
        return " or ".join(dict.fromkeys(map(_kind, schema["anyOf"])))
    match schema.get("type"):
        case "array":
            each = _kind(schema.get("items", {}))
            return f"list ({each})" if each else "list"
        case "object":
            return "dict"
        case kind:
            return {"number": "number", "integer": "whole number", "string": "text", "boolean": "True or False"}.get(str(kind), "")
