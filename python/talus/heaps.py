"""Heaps as arrays: simulated, read, drawn and compared."""
import os
import re
from collections.abc import Mapping

import numpy

from . import _core
from .plain import path_text, plain, truth, whole

# What stands beside a frame in result.json and in the attributes of Campaign.aehp().
_BESIDE_FRAMES = {"file", "film", "long_name", "num_frames", "num_views", "sd_file"}


def _frame(frame):
    if not isinstance(frame, Mapping):
        raise _core.ConfigError("frame: must be a dictionary")
    return plain({key: value for key, value in frame.items() if key not in _BESIDE_FRAMES}, "frame")


def _as_called(text):
    """The remedy at the end with arguments of `simulate` in place of the program's flags."""
    told, semicolon, remedy = text.rpartition("; ")
    remedy = re.sub(r"\banother (with )?--out\b", "another folder", remedy).replace(" with --out", "")
    return told + semicolon + remedy.replace("or --fresh to", "or fresh=True to")


def simulate(file: str | os.PathLike, folder: str | os.PathLike, fresh: bool = False) -> None:
    """Runs a case of a bulk test or a scene, as `talus simulate` does.

    `file`: the case or scene, JSON. `folder`: where its results go; it is made, goes on from a checkpoint and keeps a
    result that it has. `fresh`: takes away what is in it and begins anew. Other threads run meanwhile.

    Raises ConfigError where the input or the folder is not in order, Error where the simulation fails.
    """
    try:
        _core.simulate(path_text(file, "file"), path_text(folder, "folder"), truth(fresh, "fresh"))
    except (_core.ConfigError, _core.Error) as error:
        raise type(error)(_as_called(str(error))) from None


def read_image(file: str | os.PathLike) -> numpy.ndarray:
    """A grey image, such as a trial's `profile.png`: bytes (rows, columns), row by row from the top. Raises ConfigError
    for a file that is no image."""
    return _core.read_image(path_text(file, "file"))


def project(spheres: numpy.ndarray, frame: Mapping[str, float], num_views: int = 16) -> numpy.ndarray:
    """The average heap profile of spheres (ANHP): what a camera sees of them, mean over views round the plate.

    `spheres`: an array (n, 4): x, y, z above the plate and diameter [m]. `frame`: a dictionary as in specs: width_px,
    height_px, pixel_size [m], center_x_px, baseline_px, plate_diameter [m]; `profile` of a trial's result.json and
    `Campaign.aehp().attrs` are frames, too. `num_views`: over 180°, 1 to 3600.

    Returns bytes (height_px, width_px), row by row from the top, 0 where all views see powder and 255 where none does.
    Raises ConfigError for spheres that are no numbers or wider than the plate, for a frame that is not in order, and for
    `num_views` that is no such number.
    """
    return _core.project(spheres, _frame(frame), whole(num_views, "num_views", 1, 3600))


def compare(heap: numpy.ndarray, reference: numpy.ndarray, frame: Mapping[str, float]) -> dict[str, float | None]:
    """Every metric between two profiles of one frame.

    `heap`, `reference`: bytes (height_px, width_px), as `project` returns them and `profile.png` holds them. `frame`:
    a dictionary, as for `project`.

    Returns the metrics by name, which ends with the unit ("sad_mm2"); None where one is not defined. Raises ConfigError
    for arrays of another kind or shape.
    """
    return _core.compare(heap, reference, _frame(frame))
