#!/usr/bin/env python3
"""The model of own_model as a program: two_storey_frame.py points.csv log_likelihoods.csv

Reads the points that the sampler asks for, a row each, and writes a log-likelihood for each, in the same order. Standard
library only. Put your own model in the place of log_likelihood()."""
import csv
import math
import os
import sys

FLOOR_MASS_KG = 16000.0
STOREY_STIFFNESS_N_PER_M = 3e7


def frequencies_hz(stiffness_1, stiffness_2):
    """Natural frequencies of both modes, ascending."""
    unit = STOREY_STIFFNESS_N_PER_M / FLOOR_MASS_KG
    half_sum = 0.5 * unit * (stiffness_1 + 2.0 * stiffness_2)
    product = unit * unit * stiffness_1 * stiffness_2
    larger = half_sum + math.sqrt(half_sum * half_sum - product)
    return tuple(math.sqrt(x) / (2.0 * math.pi) for x in (product / larger, larger))


def log_likelihood(measured, stiffness_1, stiffness_2, relative_noise):
    model = frequencies_hz(stiffness_1, stiffness_2)
    total = 0.0
    for mode, frequency in measured:
        sd = relative_noise * model[mode - 1]
        total -= 0.5 * math.log(2.0 * math.pi) + math.log(sd) + 0.5 * ((frequency - model[mode - 1]) / sd) ** 2
    return total


def main(points_path, results_path):
    data = os.path.join(os.path.dirname(os.path.abspath(__file__)), "frame_observations.csv")
    with open(data) as file:
        measured = [(int(row["mode"]), float(row["frequency_hz"])) for row in csv.DictReader(file)]
    with open(points_path) as points, open(results_path, "w") as results:
        print("log_likelihood", file=results)
        for row in csv.DictReader(points):
            print(repr(log_likelihood(measured, **{name: float(value) for name, value in row.items()})), file=results)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
