#!/usr/bin/env python3
"""The oscillator of bouc_wen.py behind UM-Bridge, protocol 1.0, in Python's standard library: um_bridge.py [PORT]

For own_model --um-bridge http://localhost:PORT --model bouc_wen. The model has one input vector, the four parameters, and one output,
the log-likelihood. Without PORT a free one is taken; the first line that is printed is the address. With the package umbridge the
model is a class of a few lines."""
import json
import sys
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import bouc_wen

MODEL = "bouc_wen"
SIZES = {"/InputSizes": {"inputSizes": [len(bouc_wen.PARAMETERS)]}, "/OutputSizes": {"outputSizes": [1]}}


class Handler(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"  # connections are kept
    disable_nagle_algorithm = True
    wbufsize = -1  # header and body in one packet

    def do_GET(self):
        self.reply({"protocolVersion": 1.0, "models": [MODEL]} if self.path == "/Info" else None)

    def do_POST(self):
        request = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
        if request["name"] != MODEL:
            return self.fail("ModelNotFound", request["name"])
        if self.path == "/ModelInfo":
            return self.reply({"support": {"Evaluate": True}})
        if self.path == "/Evaluate":
            if [len(vector) for vector in request["input"]] != [len(bouc_wen.PARAMETERS)]:
                return self.fail("InvalidInput", f"expected {len(bouc_wen.PARAMETERS)} numbers")
            return self.reply({"output": [bouc_wen.log_likelihood(request["input"]).tolist()]})
        return self.reply(SIZES.get(self.path))

    def fail(self, kind, message):
        self.reply({"error": {"type": kind, "message": message}}, 400)

    def reply(self, answer, status=200):
        body = json.dumps(answer or {"error": {"type": "NotFound", "message": self.path}}).encode()
        self.send_response(status if answer else 404)
        self.send_header("Content-Type", "application/json")
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)
        self.wfile.flush()

    def log_message(self, *arguments):
        pass


if __name__ == "__main__":
    server = ThreadingHTTPServer(("localhost", int(sys.argv[1]) if len(sys.argv) > 1 else 0), Handler)
    print(f"http://localhost:{server.server_port}", flush=True)
    server.serve_forever()
