#!/usr/bin/python3
"""drawn_heap.py: a simulation that costs 30 ms, for benches of what goes on round simulations.

Reads heap.json in its folder (deck/heap.json, filled in by `talus`), draws a heap on its plate into heap.png, in the
frame of twin.py, and writes what falls off the plate to scalars.json. Slope, tip and mass follow both frictions and
the surface energy smoothly. A lower restitution steepens the heap and keeps powder on a wide plate, a slippery plate
lets the heap spread where it has room. Grains scaled up by f stand as those of larger frictions and scatter f^1.5 times.

Seeds scatter its surface in waves, as simulation does: eight heaps of 2000 grains at each of three powders have cosine
coefficients of their outline whose scatter falls from 0.2 times the height as 1/√k on a plate of 10 mm (0.06 in the
12th wave), and lies at 0.05 to 0.1 on one of 30 mm. A scatter of slope and tip alone is no stand-in: it fills two modes
of an image, and the noise of a mode is told from those that are left out (optimizer/outputs/output_noise.h).
"""
import json
import math
import pathlib
import random
import struct
import sys
import zlib

PIXEL = 1e-4  # [m]
HEIGHT, BASELINE = 120, 110  # [px]
FREE = 0.02  # plates wider than this do not bound the heap [m]
ROUGH = 0.025  # sd of the longest wave on the surface of a heap WIDTH wide, over its height
WIDTH = 0.01  # [m]
WAVES = 20


def roughness(p, chance):
    """Amplitudes of the waves on a surface of height 1 and width WIDTH, the longest first."""
    return [ROUGH * p["scale_factor"] ** 1.5 * chance.gauss(0, 1) / math.sqrt(k + 1) for k in range(WAVES)]


def shape(p, chance):
    """Height over radius of the slope, share of the tip that is rounded off, and mass fallen with its scatter [kg]."""
    f = p["scale_factor"]
    sliding = p["sliding_friction"] + 0.04 * (f - 1)
    rolling = p["rolling_friction"] + 0.03 * (f - 1)
    cohesion = math.log10(max(p["surface_energy"], 2e-3) / 2e-3)  # 0 … 1
    less_bounce = 0.9 - p["restitution"]
    slope = (0.2 + 0.9 * sliding / (0.4 + sliding) * (0.3 + rolling) + 0.2 * cohesion + 0.25 * less_bounce +
             0.05 * (0.3 - p["rolling_damping"]))
    tip = 0.45 / (1 + 4 * sliding) + 0.25 * cohesion
    if p["plate_diameter"] > FREE:
        slope *= 0.5 + 0.6 * p["plate_friction"] / (0.3 + p["plate_friction"])
        tip += 0.1 * rolling
    fallen = 0.05 * p["mass"] * math.exp(-3 * sliding - 4 * rolling - 1.5 * cohesion - 4 * less_bounce)
    grain = 8e-7 * f ** 3  # [kg]
    fallen = max(0.0, fallen + math.sqrt(grain * (fallen + grain)) * chance.gauss(0, 1))
    return slope, min(0.9, max(0.02, tip)), fallen


def heap_radius(p, slope, tip):
    """Of its foot [m]: the plate's, or where the volume of powder ends."""
    plate = p["plate_diameter"] / 2
    if p["plate_diameter"] <= FREE:
        return plate
    volume = p["mass"] / 2600
    return min(plate, (3 * volume / (math.pi * slope * (1 - tip ** 3))) ** (1 / 3))


def surface(waves, place):
    """Height of the waves at a place between 0 and 1 across the heap."""
    return sum(a * math.cos(math.pi * k * place) for k, a in enumerate(waves))


def rows(p, slope, tip, waves):
    """Grey levels: 0 where there is powder."""
    width = round(1.2 * p["plate_diameter"] / PIXEL)
    radius = heap_radius(p, slope, tip)
    rough = slope * radius * (1 - tip) * math.sqrt(WIDTH / (2 * radius))  # [m]
    tops = []
    for x in range(width):
        across = (x + 0.5 - width / 2) * PIXEL
        smooth = slope * (radius - max(abs(across), tip * radius))
        rise = rough * surface(waves, 0.5 + 0.5 * across / radius) if smooth > 0 else 0
        tops.append(max(0.0, smooth + rise) / PIXEL)
    return [bytes(255 - round(255 * min(1.0, max(0.0, top - (BASELINE - 1 - y)))) if y < BASELINE else 255
                  for top in tops) for y in range(HEIGHT)]


def png(lines):
    def chunk(name, content):
        body = name + content
        return struct.pack(">I", len(content)) + body + struct.pack(">I", zlib.crc32(body))
    head = struct.pack(">IIBBBBB", len(lines[0]), len(lines), 8, 0, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) +
            chunk(b"IDAT", zlib.compress(b"".join(b"\0" + line for line in lines))) + chunk(b"IEND", b""))


def draw(p, folder):
    chance = random.Random(p["seed"])
    slope, tip, fallen = shape(p, chance)
    (folder / "heap.png").write_bytes(png(rows(p, slope, tip, roughness(p, chance))))
    (folder / "scalars.json").write_text(json.dumps({"mass_fallen_kg": fallen}))


if __name__ == "__main__":
    if sys.argv[1:]:  # argparse would cost each heap a third of its time
        print(__doc__)
        sys.exit(sys.argv[1:] != ["--help"])
    draw(json.loads(pathlib.Path("heap.json").read_text()), pathlib.Path())
