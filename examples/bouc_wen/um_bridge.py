#!/usr/bin/env python3
"""The oscillator of bouc_wen.py behind UM-Bridge: um_bridge.py [PORT]

For own_model --um-bridge http://localhost:PORT --model bouc_wen. The model has one input vector, the four parameters, and one output,
the log-likelihood."""
import os
import sys

import bouc_wen

sys.path.append(os.path.join(os.path.dirname(os.path.realpath(__file__)), ".."))
from um_bridge_server import serve  # noqa: E402

serve({"bouc_wen": ([len(bouc_wen.PARAMETERS)], [1], lambda inputs: [bouc_wen.log_likelihood(inputs).tolist()])})
