#!/usr/bin/env python3
"""Makes frame_observations.csv: eight measurements of each natural frequency of the two-storey frame of own_model, stiffness
multipliers 0.9 and 1.2, relative noise 0.01. Standard library only; the seed is fixed."""
import random

from two_storey_frame import frequencies_hz

generator = random.Random(20230903)
print("mode,frequency_hz")
for mode, frequency in enumerate(frequencies_hz(0.9, 1.2), start=1):
    for _ in range(8):
        print(f"{mode},{frequency * (1 + 0.01 * generator.gauss(0, 1)):.4f}")
