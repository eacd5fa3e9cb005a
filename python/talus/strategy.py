"""Ask and tell."""
from . import _core


def _named(parameter):
    """`min` and `max`, as specs have them, are `low` and `high`."""
    parameter = dict(parameter)
    for name, other in (("min", "low"), ("max", "high")):
        if name in parameter:
            if other in parameter:
                raise _core.ConfigError(f"{parameter.get('name', 'parameters')}: has {name} and {other}; give one")
            parameter[other] = parameter.pop(name)
    return parameter


class Strategy(_core.Strategy):
    __doc__ = _core.Strategy.__doc__

    def __init__(self, parameters, *arguments, **keys):
        super().__init__([_named(parameter) for parameter in parameters], *arguments, **keys)
        self._names = [parameter["name"] for parameter in parameters]

    def __repr__(self):
        return f"<talus.Strategy of {', '.join(self._names)}>"
