"""Ask and tell."""
import re
from collections.abc import Mapping

from . import _core
from .plain import plain, real, truth, whole


def _named(parameter, place):
    """`min` and `max`, as specs have them, are `low` and `high`."""
    here = f"parameters[{place}]"
    if not isinstance(parameter, Mapping):
        raise _core.ConfigError(f"{here}: must be a dictionary with name, min and max")
    parameter = plain(parameter, here)
    for name, other in (("min", "low"), ("max", "high")):
        if name in parameter:
            if other in parameter:
                raise _core.ConfigError(f"{parameter.get('name', 'parameters')}: has {name} and {other}; give one")
            parameter[other] = parameter.pop(name)
        elif other not in parameter and "fixed" not in parameter and not parameter.get("levels"):
            raise _core.ConfigError(f"{here}.{name}: is missing; give min and max, levels, or a fixed value")
    return parameter


def _as_written(text, parameters):
    """The C++ part's words without places in a JSON that nobody has written, and with `min` and `max` where a parameter has
    these."""
    def line(words):
        words = re.sub(r"^(parameters|options):\d+:\d+: ", lambda at: "" if at[1] == "parameters" else "options: ", words)
        at = re.match(r"parameters\[(\d+)\]", words)
        if not at or {"low", "high"} & set(parameters[int(at[1])]):
            return words
        # A text in quotes is the user's own.
        return re.sub(r'"[^"]*"|\blow\b|\bhigh\b', lambda word: {"low": "min", "high": "max"}.get(word[0], word[0]), words)

    return "\n".join(map(line, text.splitlines()))


class Strategy:
    """Chooses the next parameter sets of expensive, noisy evaluations.

    `parameters`: dictionaries with name, min, max and, if wanted, scale ("linear" or "log"), guess, fixed, levels.
    `options`: those of a campaign's strategy, such as {"kind": "gp"}. With `target`, the measured image, evaluations
    may bring images; `pixel_area` makes the sum of absolute differences an area. Equal arguments and evaluations
    make equal proposals.
    """

    def __init__(self, parameters, options=None, seed=1, target=None, pixel_area=1.0):
        if isinstance(parameters, (str, bytes, Mapping)) or not hasattr(parameters, "__iter__"):
            raise _core.ConfigError("parameters: must be a list of dictionaries with name, min and max")
        parameters = list(parameters)
        named = [_named(parameter, place) for place, parameter in enumerate(parameters)]
        seed = whole(seed, "seed", 0, 2**64 - 1)
        pixel_area = real(pixel_area, "pixel_area")
        if options is not None and not isinstance(options, Mapping):
            raise _core.ConfigError("options: must be a dictionary, such as {\"kind\": \"gp\"}")
        options = plain(options or {}, "options")
        try:
            self._core = _core.Strategy(named, options, seed, target, pixel_area)
        except _core.ConfigError as error:
            raise _core.ConfigError(_as_written(str(error), parameters)) from None
        self._names = [parameter["name"] for parameter in named]

    def ask(self, count=1):
        """Up to `count` (1 to 8) sets to evaluate; fewer, or none, when there are no more. Each is to be told, if only
        that it failed: the search waits for it."""
        return self._core.ask(whole(count, "count", 1, 8))

    def tell(self, values, value=None, image=None, failed=False):
        """One evaluation: its value, which is minimised, or its image; or that it failed. NaN and infinity count as
        failed, too. Levels and fixed values must be those that the strategy has."""
        if not isinstance(values, Mapping):
            raise _core.ConfigError("values: must be a dictionary of the parameters by name")
        self._core.tell(dict(values), value, image, truth(failed, "failed"))

    def stop_reason(self):
        """Why going on is not worth it, or not possible: the strategy has no more points, or the first eight
        evaluations all failed. None while it is."""
        return self._core.stop_reason()

    def answer(self):
        """`values` of the recommended set, `predicted`, `predicted_sd`, `noise_sd`, `ranges_90` (90 % for all
        parameters together), `tied_volume`, `is_guess`. None where no model knows it."""
        return self._core.answer()

    def __repr__(self):
        return f"<talus.Strategy of {', '.join(self._names)}>"
