"""A server of UM-Bridge, protocol 1.0, in Python's standard library: the models of the examples as own_model --um-bridge calls them.
With the package umbridge a model is a class of a few lines."""
import json
import sys
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer


def serve(models):
    """Serves models until it is stopped, on the port that the command line names or else on a free one. The first line that is
    printed is the address.

    models: by name the sizes of the input vectors, the sizes of the output vectors, and the function from inputs to outputs."""

    class Handler(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"  # connections are kept
        disable_nagle_algorithm = True
        wbufsize = -1  # header and body in one packet

        def do_GET(self):
            self.reply({"protocolVersion": 1.0, "models": list(models)} if self.path == "/Info" else None)

        def do_POST(self):
            request = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
            if request["name"] not in models:
                return self.fail("ModelNotFound", request["name"])
            input_sizes, output_sizes, evaluate = models[request["name"]]
            if self.path == "/Evaluate":
                if [len(vector) for vector in request["input"]] != input_sizes:
                    return self.fail("InvalidInput", f"expected sizes {input_sizes}")
                return self.reply({"output": evaluate(request["input"])})
            answers = {"/ModelInfo": {"support": {"Evaluate": True}}, "/InputSizes": {"inputSizes": input_sizes},
                       "/OutputSizes": {"outputSizes": output_sizes}}
            return self.reply(answers.get(self.path))

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

    server = ThreadingHTTPServer(("localhost", int(sys.argv[1]) if len(sys.argv) > 1 else 0), Handler)
    print(f"http://localhost:{server.server_port}", flush=True)
    server.serve_forever()
