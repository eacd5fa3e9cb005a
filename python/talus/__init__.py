"""Calibrated DEM parameters from photographs of powder heaps: talus from Python.

- :class:`Campaign` reads a campaign's folder, also while it runs: trials and draws of the posterior as
  pandas tables, profiles as arrays.
- :class:`Strategy` proposes the next parameter sets for simulations of your own (ask and tell).
- :func:`simulate` runs a case or a scene; :func:`project` turns spheres into an average heap profile;
  :func:`compare` measures how far two profiles differ.

Quantities are in SI units. Images are arrays of bytes, row by row from the top, 0 powder and 255 none.
Bad input raises :class:`ConfigError`, a ValueError that names what is wrong and the remedy.
"""
from ._core import ConfigError, Error, Strategy, __version__, compare, project, simulate
from .campaign import Campaign

__all__ = ["Campaign", "ConfigError", "Error", "Strategy", "compare", "project", "simulate",
           "__version__"]
