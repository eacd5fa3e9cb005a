"""Stands for somebody else's simulation in optimize_test.cc; the first argument says how it acts."""
import json
import math
import os
import pathlib
import signal
import struct
import sys
import zlib

kind = sys.argv[1]
p = json.load(sys.stdin)


def heap(a, b):
    """24 x 32 pixels, 1 = powder: a is the steepness, b the rounding."""
    steep, rounding = 0.4 + 0.8 * a, 1 + 6 * b
    tops = [16 - 2 * b - steep * (math.hypot(x - 15.5, rounding) - rounding) for x in range(32)]
    edge = [[(max(0.0, top) - (23.5 - y)) / 1.2 for top in tops] for y in range(24)]
    return [[0.5 * math.erfc(-t / math.sqrt(2)) for t in row] for row in edge]


def png(rows):
    """An 8-bit grey PNG, black where there is powder."""
    def chunk(name, data):
        body = name + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    head = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    lines = b"".join(b"\0" + bytes(round(255 * (1 - v)) for v in row) for row in rows)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(lines)) +
            chunk(b"IEND", b""))


if kind == "crash" or (kind == "value" and p["a"] > 0.9):
    sys.exit("no heap formed")
if kind == "value":
    print(json.dumps({"value": (p["a"] - 0.3) ** 2 + math.log10(p["b"] / 1e-4) ** 2}))
elif kind == "field":
    print(json.dumps({"field": heap(p["a"], p["b"])}))
elif kind == "profile":
    # One file an evaluation: several may run at a time.
    name = f"heap_{p['seed']}.png"
    pathlib.Path(name).write_bytes(png(heap(p["a"], p["b"])))
    print(json.dumps({"profile": name}))
elif kind == "csv":
    rows = heap(p["a"], p["b"])
    number = p.get("seed", 1000003) - 1000003
    if os.environ.get("KILL_AT") == str(number):
        os.kill(os.getppid(), signal.SIGKILL)
    name = f"heap_{number}.csv"
    pathlib.Path(name).write_text("\n".join(",".join(map(str, row)) for row in rows) + "\n")
    print(json.dumps({"profile": name}))
elif kind in ("bowl", "moody"):
    number = p["seed"] - 1000003
    moods = ["{}", '{"value": NaN}', '{"value": 1e400}', '{"value": null}', ""]
    value = json.dumps({"value": (p["a"] - 0.3) ** 2 + (p["b"] - 0.6) ** 2})
    sensible = kind == "bowl" or number % 6 != 5
    print(value if sensible else "warning: cold\n" + value if number == 5
          else moods[number // 6])
elif kind == "nonsense":
    print("0.25")
