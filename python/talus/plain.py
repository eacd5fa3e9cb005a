"""Values as JSON and the C++ part have them, out of what people have in notebooks."""
import math
import numbers
import os
from collections.abc import Mapping

import numpy

from ._core import ConfigError


def plain(value, name):
    """`value`, which error messages call `name`, with numpy's numbers and arrays as Python's own."""
    if value is None or isinstance(value, (str, bool)):
        return value
    if isinstance(value, Mapping):
        return {str(key): plain(item, f"{name}.{key}") for key, item in value.items()}
    if hasattr(value, "tolist"):  # numpy's and pandas' own
        return plain(value.tolist(), name)
    if isinstance(value, (list, tuple)):
        return [plain(item, f"{name}[{place}]") for place, item in enumerate(value)]
    if isinstance(value, numbers.Real):
        number = real(value, name)
        if not math.isfinite(number):
            raise ConfigError(f"{name}: is {value}, must be a finite number")
        return int(value) if isinstance(value, numbers.Integral) else number
    raise ConfigError(f"{name}: is a {type(value).__name__}, which JSON has not: {value!r}")


def real(value, name):
    """A number, which may be numpy's, NaN or infinite."""
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise ConfigError(f"{name}: must be a number; it is a {type(value).__name__}")
    try:
        return float(value)
    except OverflowError:
        raise ConfigError(f"{name}: is beyond 1.8e308, the largest number there is") from None


def whole(value, name, low, high):
    """A whole number from `low` to `high`, which may be numpy's."""
    if isinstance(value, (bool, numpy.bool_)) or not isinstance(value, numbers.Integral) or not low <= value <= high:
        raise ConfigError(f"{name}: must be a whole number from {low} to {high}; it is {value!r}")
    return int(value)


def truth(value, name):
    """True or False, which may be numpy's."""
    if not isinstance(value, (bool, numpy.bool_)):
        raise ConfigError(f"{name}: must be True or False; it is {value!r}")
    return bool(value)


def path_text(file, name):
    """A path as UTF-8 has it, as results and messages do; `name` is the argument's."""
    if not isinstance(file, (str, bytes, os.PathLike)):
        raise ConfigError(f"{name}: must be a path; it is a {type(file).__name__}")
    text = os.fsdecode(file)
    if not text:
        raise ConfigError(f"{name}: is empty; give a path")
    if "\0" in text:
        raise ConfigError(f"{name}: {text!r} has a NUL byte, which no path has; take it out")
    try:
        text.encode()
    except UnicodeEncodeError:
        raise ConfigError(f"{name}: {text!r} is no name in UTF-8; rename it") from None
    return text
