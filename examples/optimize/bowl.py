#!/usr/bin/env python3
"""A stand-in for a simulation: reads parameters, writes a value that scatters from seed to seed."""
import json
import math
import random
import sys

p = json.load(sys.stdin)
random.seed(p["seed"])
value = (p["mu_t"] - 0.3) ** 2 + 0.1 * math.log10(p["gamma"] / 5e-5) ** 2
print(json.dumps({"value": value + 0.01 * random.gauss(0, 1)}))
