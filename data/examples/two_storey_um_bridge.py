#!/usr/bin/env python3
"""The model of two_storey_frame.py behind UM-Bridge: two_storey_um_bridge.py [PORT]

For own_model --um-bridge http://localhost:PORT --model NAME. The model "posterior" gives the log-likelihood, "forward" the two
natural frequencies, Hz."""
import csv
import os
import sys

from two_storey_frame import frequencies_hz, log_likelihood

HERE = os.path.dirname(os.path.realpath(__file__))
sys.path.append(os.path.join(HERE, "..", "..", "examples"))
from um_bridge_server import serve  # noqa: E402

with open(os.path.join(HERE, "frame_observations.csv")) as file:
    MEASURED = [(int(row["mode"]), float(row["frequency_hz"])) for row in csv.DictReader(file)]

serve({
    "posterior": ([3], [1], lambda inputs: [[log_likelihood(MEASURED, *inputs[0])]]),
    "forward": ([2], [2], lambda inputs: [list(frequencies_hz(*inputs[0]))]),
})
