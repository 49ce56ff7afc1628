#!/usr/bin/env python3
"""The model of two_storey_frame.py as a server of UM-Bridge, protocol 1.0: two_storey_um_bridge.py [PORT]

For own_model --um-bridge http://localhost:PORT --model NAME. The model "posterior" gives the log-likelihood, "forward" the two
natural frequencies, Hz. Without PORT a free one is taken; the first line that is printed is the address. Standard library only; with
the package umbridge a model is a class of a few lines."""
import csv
import json
import os
import sys
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

from two_storey_frame import frequencies_hz, log_likelihood

with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "frame_observations.csv")) as file:
    MEASURED = [(int(row["mode"]), float(row["frequency_hz"])) for row in csv.DictReader(file)]

#: of each model: sizes of the inputs and outputs, and the function from inputs to outputs
MODELS = {
    "posterior": ([3], [1], lambda inputs: [[log_likelihood(MEASURED, *inputs[0])]]),
    "forward": ([2], [2], lambda inputs: [list(frequencies_hz(*inputs[0]))]),
}


class Handler(BaseHTTPRequestHandler):
    def do_GET(self):
        self.reply({"protocolVersion": 1.0, "models": list(MODELS)} if self.path == "/Info" else None)

    def do_POST(self):
        request = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
        if request["name"] not in MODELS:
            return self.reply({"error": {"type": "ModelNotFound", "message": request["name"]}}, 400)
        input_sizes, output_sizes, evaluate = MODELS[request["name"]]
        if self.path == "/ModelInfo":
            return self.reply({"support": {"Evaluate": True}})
        if self.path == "/InputSizes":
            return self.reply({"inputSizes": input_sizes})
        if self.path == "/OutputSizes":
            return self.reply({"outputSizes": output_sizes})
        if self.path == "/Evaluate":
            if [len(vector) for vector in request["input"]] != input_sizes:
                return self.reply({"error": {"type": "InvalidInput", "message": f"expected sizes {input_sizes}"}}, 400)
            return self.reply({"output": evaluate(request["input"])})
        return self.reply(None)

    def reply(self, answer, status=200):
        body = json.dumps(answer or {"error": {"type": "NotFound", "message": self.path}}).encode()
        self.send_response(status if answer else 404)
        self.send_header("Content-Type", "application/json")
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, *arguments):
        pass


if __name__ == "__main__":
    server = ThreadingHTTPServer(("localhost", int(sys.argv[1]) if len(sys.argv) > 1 else 0), Handler)
    print(f"http://localhost:{server.server_port}", flush=True)
    server.serve_forever()
