"""Values as JSON has them, out of what people have in notebooks."""
import math
import numbers
from collections.abc import Mapping

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
    if isinstance(value, numbers.Integral):
        return int(value)
    if isinstance(value, numbers.Real):
        if not math.isfinite(value):
            raise ConfigError(f"{name}: is {value}, must be a finite number")
        return float(value)
    raise ConfigError(f"{name}: is a {type(value).__name__}, which JSON has not: {value!r}")
