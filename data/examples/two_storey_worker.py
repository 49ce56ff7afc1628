#!/usr/bin/env python3
"""The model of two_storey_frame.py as a worker, for own_model --worker: started once, it answers batch after batch.

A batch is a line with the number n of its points, then n lines with the coordinates of a point, with commas between them in the
order of the arguments, which are the names of the parameters. The answer is n lines with a log-likelihood each."""
import csv
import os
import sys

from two_storey_frame import log_likelihood

with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "frame_observations.csv")) as file:
    MEASURED = [(int(row["mode"]), float(row["frequency_hz"])) for row in csv.DictReader(file)]

names = sys.argv[1:]
for line in sys.stdin:
    points = [map(float, sys.stdin.readline().split(",")) for _ in range(int(line))]
    print(*[repr(log_likelihood(MEASURED, **dict(zip(names, point)))) for point in points], sep="\n", flush=True)
