"""Conversion of Python values to TOML, for scenes from dictionaries."""

import collections.abc
import decimal
import json
import math
import numbers
import os

import numpy


def to_toml(values):
    """Converts a dictionary to the text of a TOML file, with each top-level key on a line of its own.

    Accepts texts, paths, booleans, numbers, sequences and mappings, and numbers and arrays of numpy.
    Raises TypeError or ValueError, with the key, for anything else.
    """
    if not isinstance(values, collections.abc.Mapping):
        raise TypeError(f"a scene is a dictionary, not {_kind(values)}")
    return "".join(f"{_key(key, '')} = {_value(item, str(key))}\n" for key, item in values.items())


def _kind(value):
    return "None" if value is None else f"a value of type {type(value).__module__}.{type(value).__qualname__}".replace(
        "builtins.", "")


def _text(text, path):
    """JSON's escapes are valid in TOML, except for surrogate pairs."""
    try:
        text.encode("utf-8")
    except UnicodeEncodeError as fault:
        raise ValueError(f"{path}: {text!r} is no text in UTF-8") from fault
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _key(key, path):
    if not isinstance(key, str):
        raise TypeError(f"{path or 'the scene'}: a key is a text, not {key!r} ({_kind(key)})")
    return _text(key, f"{path}.{key}" if path else key)


def _integer(value, path):
    if not -2**63 <= value < 2**63:
        raise ValueError(f"{path}: {value} is out of the range of 64-bit integers")
    return str(value)


def _real(value, path):
    real = float(value)
    # Decimals and long doubles have a wider range.
    if (math.isinf(real) and value not in (math.inf, -math.inf)) or (real == 0 and value != 0):
        raise ValueError(f"{path}: {value} is out of the range of double precision")
    if math.isnan(real):
        return "nan"
    if math.isinf(real):
        return "inf" if real > 0 else "-inf"
    return repr(real)


def _table(value, path):
    return "{" + ", ".join(f"{_key(key, path)} = {_value(item, f'{path}.{key}')}" for key, item in value.items()) + "}"


def _value(value, path):
    if isinstance(value, numpy.ma.MaskedArray) and numpy.ma.is_masked(value):
        raise TypeError(f"{path}: masked values have no place in a scene")
    # Arrays and numbers of numpy and compatible libraries.
    if hasattr(value, "tolist") and not isinstance(value, memoryview):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return _integer(int(value), path)
    if isinstance(value, (numbers.Real, decimal.Decimal)):
        try:
            return _real(value, path)
        except OverflowError:  # of a fraction
            raise ValueError(f"{path}: {value} is out of the range of double precision") from None
    if isinstance(value, str):
        return _text(value, path)
    if isinstance(value, os.PathLike):
        return _text(os.fsdecode(value), path)
    if isinstance(value, collections.abc.Mapping):
        return _table(value, path)
    if isinstance(value, collections.abc.Sequence) and not isinstance(value, (bytes, bytearray, memoryview)):
        return "[" + ", ".join(_value(item, f"{path}.{number}") for number, item in enumerate(value)) + "]"
    hint = ": leave the key out" if value is None else ""
    raise TypeError(f"{path}: {_kind(value)} has no place in a scene, a text, number, boolean, list or dictionary is needed"
                    f"{hint}")
