"""Calibrated DEM parameters from photographs of powder heaps: talus from Python.

- :func:`calibrate` runs a campaign from its spec; :class:`Campaign` reads a campaign's folder, also while it runs:
  trials and draws of the posterior as pandas tables, profiles with their coordinates, and asks it: what of a set,
  what next.
- :class:`Strategy` proposes the next parameter sets for simulations of your own (ask and tell).
- :func:`simulate` runs a case or a scene; :func:`project` turns spheres into an average heap profile;
  :func:`compare` measures how far two profiles differ.

Quantities are in SI units. Images are arrays of bytes, row by row from the top, 0 powder and 255 none.
Bad input raises :class:`ConfigError`, a ValueError that names what is wrong and the remedy.
"""
from ._core import ConfigError, Error, __version__, compare, project, simulate
from .campaign import Campaign, calibrate
from .strategy import Strategy

__all__ = ["Campaign", "ConfigError", "Error", "Strategy", "calibrate", "compare", "project", "simulate",
           "__version__"]
