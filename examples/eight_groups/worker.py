#!/usr/bin/env python3
"""The effects theta_1 ... theta_8 of a point are the outputs of the model: a line of eight numbers for each point."""
import sys

first = sys.argv[1:].index("theta_1")
for line in sys.stdin:
    points = [sys.stdin.readline().strip().split(",") for _ in range(int(line))]
    print(*[",".join(point[first:]) for point in points], sep="\n", flush=True)
