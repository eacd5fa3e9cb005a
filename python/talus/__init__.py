"""Calibrated DEM parameters from photographs of powder heaps: talus from Python.

- :func:`calibrate` runs a campaign from its spec; :class:`Campaign` reads a campaign's folder, also while it runs:
  trials and draws of the posterior as pandas tables, profiles with their coordinates, and asks it: what of a set,
  what next.
- :class:`Strategy` proposes the next parameter sets for simulations of your own (ask and tell).
- :func:`simulate` runs a case or a scene; :func:`project` turns spheres into an average heap profile;
  :func:`compare` measures how far two profiles differ; :func:`read_image` reads one.

Quantities are in SI units. Images are arrays of bytes, row by row from the top, 0 powder and 255 none.
Bad input raises :class:`ConfigError`, a ValueError that names what is wrong and the remedy.
"""
import os

# OpenMP reads it when the C++ part is loaded: between two loops its threads sleep, as those of the program do.
_unset = "OMP_WAIT_POLICY" not in os.environ
if _unset:
    os.environ["OMP_WAIT_POLICY"] = "passive"
from ._core import ConfigError, Error, __version__, stay_on_one_thread  # noqa: E402

if _unset:
    del os.environ["OMP_WAIT_POLICY"]
os.register_at_fork(after_in_child=stay_on_one_thread)
from .campaign import Campaign, calibrate  # noqa: E402
from .heaps import compare, project, read_image, simulate  # noqa: E402
from .strategy import Strategy  # noqa: E402

__all__ = ["Campaign", "ConfigError", "Error", "Strategy", "calibrate", "compare", "project", "read_image",
           "simulate", "__version__"]
