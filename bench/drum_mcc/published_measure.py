#!/usr/bin/python3
"""published_measure.py TRIAL PHOTO: how far a simulated drum is from its photograph by the published calibration's
own code, which is not the area between "any picture" and "any picture" that `drum_residual` measures.

It spreads each grain over the area that it sweeps from one picture to the next, less the circle where it arrives, so that a pixel holds
how many grains pass one behind another. That is powder where it exceeds 10/255 of the largest pixel: about half a grain, where half of the
pictures are dark. The photograph, a mean of silhouettes, is powder where 30/255 of the light is missing. Both are closed over 7 px and
compared inside √0.6 of the drum's radius.

TRIAL needs `state_0000.vtp` … at the pictures' times (`outputs.times` of its case, from one picture to the next 10 ms).
"""
import argparse
import pathlib
import sys

import numpy
from drum_pictures import RADIUS, array, counted, pixel_area
from PIL import Image

CLOSING = 7  # [px]
PHOTO_CUT, SIMULATED_CUT = 30, 10  # of 255
BATCH = 4000  # segments at a time


def grains(file):
    """Radii and places seen from the front, from the drum's axis, by number of the grain [mm]."""
    text = file.read_text()
    order = numpy.argsort(array(text, "id"))
    places = 1e3 * array(text, "Points").reshape(-1, 3)[order]
    return 500 * array(text, "diameter_m")[order], numpy.column_stack([places[:, 0], places[:, 2] - RADIUS])


def add_swept(image, pixel, radius, begin, end, is_last):
    """Adds the share of its swept area that each segment lays on each pixel, without the circle at its end unless it is the last."""
    n = image.shape[0]
    way = end - begin
    length = numpy.hypot(*way.T)
    along = way / numpy.maximum(length, 1e-12)[:, None]
    low = numpy.floor((numpy.minimum(begin, end) - radius[:, None] + RADIUS) / pixel).astype(int)
    span = numpy.floor((numpy.maximum(begin, end) + radius[:, None] + RADIUS) / pixel).astype(int) - low + 1
    i, j = (axis.ravel()[None] for axis in numpy.indices((span[:, 0].max(), span[:, 1].max())))
    i, j = i + low[:, :1], j + low[:, 1:]
    x = (i + 0.5) * pixel - RADIUS - begin[:, :1]
    y = (j + 0.5) * pixel - RADIUS - begin[:, 1:]
    s = x * along[:, :1] + y * along[:, 1:]
    aside = (y * along[:, :1] - x * along[:, 1:]) ** 2
    l, r2 = length[:, None], radius[:, None] ** 2
    behind = s - numpy.clip(s, 0, l)
    inside = behind ** 2 + aside < r2
    if not is_last:
        inside &= (s <= l) & ((s - l) ** 2 + aside >= r2)
    inside &= (i >= 0) & (i < n) & (j >= 0) & (j < n)
    share = pixel ** 2 / (2 * radius * length + numpy.pi * radius ** 2)
    at = (i * n + j)[inside]
    weights = numpy.broadcast_to(share[:, None], inside.shape)[inside]
    image += numpy.bincount(at, weights, n * n).reshape(n, n)


def swept(trial, size):
    states = [grains(file) for file in sorted(trial.glob("state_*.vtp"))]
    if len(states) < 2:
        sys.exit(f"{trial}: has no state_0000.vtp, state_0001.vtp …: name the pictures' times as outputs.times of its case")
    image = numpy.zeros((size, size))
    for k, ((radius, begin), (_, end)) in enumerate(zip(states, states[1:])):
        order = numpy.argsort(numpy.abs(end - begin).max(axis=1))  # those of one length together, in boxes of one size
        for part in numpy.array_split(order, max(1, len(order) // BATCH)):
            add_swept(image, 2 * RADIUS / size, radius[part], begin[part], end[part], k == len(states) - 2)
    return image


def closed(image):
    """The largest of each pixel's surroundings, then the smallest of those."""
    for pick, fill in ((numpy.max, 0), (numpy.min, 255)):
        wide = numpy.pad(image, CLOSING // 2, constant_values=fill)
        image = pick(numpy.lib.stride_tricks.sliding_window_view(wide, (CLOSING, CLOSING)), axis=(2, 3))
    return image


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("trial", metavar="TRIAL", type=pathlib.Path)
    parser.add_argument("photo", metavar="PHOTO", type=pathlib.Path)
    asked = parser.parse_args()
    dark = 255 - numpy.array(Image.open(asked.photo).convert("L"))[::-1].T
    size = dark.shape[0]
    counts = counted(size)
    image = numpy.where(counts, swept(asked.trial, size), 0)
    simulated = closed((image / image.max() * 255).astype(numpy.uint8)) > SIMULATED_CUT
    seen = closed(numpy.where(counts, dark, 0).astype(numpy.uint8)) > PHOTO_CUT
    alone = [pixel_area(size) * (a & ~b & counts).sum() for a, b in ((seen, simulated), (simulated, seen))]
    print(f"{sum(alone):.1f} mm2: powder of the photograph alone {alone[0]:.1f}, of the simulation alone {alone[1]:.1f}")


main()
