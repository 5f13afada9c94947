"""Tables of a scene from its JSON schema, as classes with fields: the source of `ashlar.keys`."""

import dataclasses
import json
import keyword


@dataclasses.dataclass
class Field:
    """A key: its name in Python and in a scene, its type as Python writes it, and its meaning."""
    name: str
    key: str
    type: str
    required: bool
    meaning: str


@dataclasses.dataclass
class Table:
    """A table of a scene."""
    name: str
    meaning: str
    fields: list


def tables_of(schema):
    """The tables of a scene, each once and after those that it contains."""
    keys = schema["properties"]
    found = {}
    for key in sorted(keys, key=lambda key: key != "block"):  # whose shapes have the shortest names
        _type(keys[key], key, found, {_name(key) for key in keys})
    return list(found.values())


def _name(path):
    return "".join(word.title() for part in path.split(".") for word in part.split("_"))


def _type(schema, path, found, reserved):
    """The type of a value as Python writes it; adds the tables in it."""
    if "anyOf" in schema:
        types = [_type(form, path, found, reserved) for form in schema["anyOf"]]
        return " | ".join(dict.fromkeys(part for text in types for part in text.split(" | ")))
    if "enum" in schema or "const" in schema:
        words = schema.get("enum", [schema.get("const")])
        return "int" if all(isinstance(word, int) for word in words) else "str"
    kind = schema.get("type")
    if kind == "array":
        return f"_Sequence[{_type(schema['items'], path, found, reserved)}]"
    if kind == "object" and "properties" in schema:
        return f"{_add(schema, path, found, reserved)} | _Mapping[str, object]"
    return {"number": "float", "integer": "int", "boolean": "bool", "string": "str",
            "object": "_Mapping[str, object]"}[kind]


def _add(schema, path, found, reserved):
    """The name of the class of a table: that of its key, with those of the tables around it where another one has it."""
    identity = json.dumps([schema["properties"], schema.get("required")], sort_keys=True)
    if identity in found:
        return found[identity].name
    required = schema.get("required", [])
    fields = [Field(key + "_" if keyword.iskeyword(key) else key, key, _type(value, f"{path}.{key}", found, reserved),
                    key in required, value.get("description", "")) for key, value in schema["properties"].items()]
    parts = path.split(".")
    taken = {table.name for table in found.values()} | (reserved if len(parts) > 1 else set())
    is_record = {"file", "time", "resample"} <= schema["properties"].keys()
    names = ["Record"] if is_record else [_name(".".join(parts[start:])) for start in range(len(parts) - 1, -1, -1)]
    name = next(name for name in names if name not in taken)
    found[identity] = Table(name, schema.get("description", ""), fields)
    return name
