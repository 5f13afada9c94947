"""Python values as TOML, for scenes that are made by programs."""

import json
import math


def to_toml(value):
    """A dictionary as the text of a TOML file: every key of the top on a line of its own."""
    return "".join(f"{_key(key)} = {_value(item)}\n" for key, item in value.items())


def _key(key):
    if not isinstance(key, str):
        raise TypeError(f"a key of a scene is a text, not {key!r}")
    return json.dumps(key)


def _number(value):
    if math.isnan(value):
        return "nan"
    if math.isinf(value):
        return "inf" if value > 0 else "-inf"
    return repr(float(value))


def _value(value):
    # numpy's arrays and numbers.
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return _number(value)
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_key(key)} = {_value(item)}" for key, item in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(item) for item in value) + "]"
    # Texts and paths. JSON's escapes are TOML's, but that TOML has no surrogate pairs.
    return json.dumps(str(value), ensure_ascii=False).replace("\x7f", "\\u007f")
