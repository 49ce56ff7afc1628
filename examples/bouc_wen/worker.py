#!/usr/bin/env python3
"""The oscillator of bouc_wen.py as a worker, for own_model --worker: a line with the number of points, the points, and back a line for
each with its log-likelihood."""
import sys

import numpy as np

import bouc_wen

assert tuple(sys.argv[1:]) == bouc_wen.PARAMETERS, f"expected the parameters {bouc_wen.PARAMETERS}"
for line in sys.stdin:
    points = np.loadtxt(sys.stdin, delimiter=",", max_rows=int(line), ndmin=2)
    print(*map(repr, bouc_wen.log_likelihood(points).tolist()), sep="\n", flush=True)
