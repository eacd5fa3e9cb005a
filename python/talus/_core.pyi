from typing import Any, Mapping, Sequence

import numpy

__version__: str

class Error(RuntimeError): ...
class ConfigError(ValueError): ...

class Strategy:
    """Chooses the next parameter sets of expensive, noisy evaluations.

    ``parameters``: dictionaries with ``name``, ``min``, ``max`` and, if wanted, ``scale`` ("linear" or
    "log"), ``guess``, ``fixed``, ``levels``. ``options``: those of a campaign's ``strategy``, such as
    ``{"kind": "gp"}``. With ``target``, the measured image, evaluations may bring images; ``pixel_area``
    makes the sum of absolute differences an area. Equal arguments and evaluations make equal proposals.
    """
    def __init__(self, parameters: Sequence[Mapping[str, Any]], options: Mapping[str, Any] = ...,
                 seed: int = ..., target: numpy.ndarray | None = ..., pixel_area: float = ...) -> None: ...
    def ask(self, count: int = ...) -> list[dict[str, float]]:
        """Up to ``count`` (1 to 8) sets to evaluate; fewer, or none, when there are no more."""
    def tell(self, values: Mapping[str, float], value: float | None = ...,
             image: numpy.ndarray | None = ..., failed: bool = ...) -> None:
        """One evaluation: its value, which is minimised, or its image; or that it failed."""
    def stop_reason(self) -> str | None:
        """Why going on is not worth it; None while it is."""
    def answer(self) -> dict[str, Any]:
        """``values`` of the recommended set, ``predicted``, ``predicted_sd``, ``noise_sd``,
        ``ranges_90`` (90 % for all parameters together), ``tied_volume``, ``is_guess``."""

def simulate(file: str, folder: str, fresh: bool = ...) -> None:
    """Runs a case or a scene into a folder, as ``talus simulate`` does; goes on from a checkpoint."""

def project(spheres: numpy.ndarray, frame: Mapping[str, float], num_views: int = ...) -> numpy.ndarray:
    """The average profile of spheres (x, y, z, diameter in metres, one a row) on the plate."""

def compare(heap: numpy.ndarray, reference: numpy.ndarray,
            frame: Mapping[str, float]) -> dict[str, float | None]:
    """Every metric between two profiles; None where it is not defined."""

def read_image(file: str) -> numpy.ndarray:
    """A grey image from a file."""

def decode_image(bytes: bytes) -> numpy.ndarray:
    """A grey image from what a file of it would hold."""
