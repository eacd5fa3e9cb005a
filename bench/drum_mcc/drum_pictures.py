"""What the scripts of this folder share: states of a simulated drum, and where its picture counts."""
import base64
import re

import numpy

RADIUS = 42.0  # of the drum [mm]
COUNTS = 0.6  # of the radius squared: farther out nothing is compared


def array(text, name):
    """A DataArray of a state, base64 after a length of eight bytes."""
    kind, body = re.search(rf'type="(\w+)" Name="{name}"[^>]*>\s*([^<\s]+)', text).groups()
    return numpy.frombuffer(base64.b64decode(body)[8:], {"Float64": "<f8", "Float32": "<f4", "Int32": "<i4", "Int64": "<i8"}[kind])


def counted(size):
    """Whether each pixel of a picture of so many a side counts."""
    across = numpy.linspace(-1, 1, size)
    return across[:, None] ** 2 + across[None] ** 2 <= COUNTS


def pixel_area(size):
    """[mm^2]"""
    return (2 * RADIUS / size) ** 2
