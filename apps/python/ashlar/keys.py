"""The tables of a scene as dataclasses: `keys.Bolt(name="anchor", from_=[0, 0, 0], to=[0, 0, 1], area=5e-4)`.

Fields are the keys of a scene file; those that are None are left out. Where a table is needed, a dictionary serves as well. The
classes are made from the schema of scenes, so that they have every key of the program.
"""

import dataclasses as _dataclasses
import json as _json

from . import _core  # type: ignore[attr-defined]  # made by the compiler
from ._key_tables import tables_of as _tables_of


def to_dict(value):
    """Tables as dictionaries with the keys of a scene, without those that are None, in lists and dictionaries too."""
    if _dataclasses.is_dataclass(value) and not isinstance(value, type):
        return {field.metadata["key"]: to_dict(getattr(value, field.name)) for field in _dataclasses.fields(value)
                if getattr(value, field.name) is not None}
    if isinstance(value, dict):
        return {key: to_dict(item) for key, item in value.items()}
    return [to_dict(item) for item in value] if isinstance(value, (list, tuple)) else value


def _class_of(table):
    fields = [(field.name, field.type, _dataclasses.field(metadata={"key": field.key}) if field.required else
               _dataclasses.field(default=None, metadata={"key": field.key})) for field in table.fields]
    lines = [table.meaning, ""] + [f"{field.name}: {field.meaning}" for field in table.fields]
    made = _dataclasses.make_dataclass(table.name, fields, kw_only=True, namespace={"__doc__": "\n".join(lines).strip()})
    made.__module__ = __name__
    return made


for _table in _tables_of(_json.loads(_core.schema())):
    globals()[_table.name] = _class_of(_table)
