#!/usr/bin/env python3
"""The oscillator of bouc_wen.py as a program for own_model --command: program.py points.csv log_likelihoods.csv

The columns of the points may stand in any order."""
import sys

import numpy as np

import bouc_wen

with open(sys.argv[1]) as file:
    columns = dict(zip(file.readline().strip().split(","), np.loadtxt(file, delimiter=",", ndmin=2).T))
values = bouc_wen.log_likelihood(np.column_stack([columns[name] for name in bouc_wen.PARAMETERS]))
with open(sys.argv[2], "w") as file:
    file.write("log_likelihood\n" + "".join(f"{value!r}\n" for value in values.tolist()))
