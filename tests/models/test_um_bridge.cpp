#include <httplib.h>

#undef _res

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <thread>

#include "errors/invalid_value.hpp"
#include "models/forward_model.hpp"
#include "models/model_error.hpp"
#include "models/parallel_batches.hpp"
#include "models/um_bridge.hpp"

using Catch::Matchers::Contains;
using models::ModelError;
using models::UmBridge;
using nlohmann::json;

namespace {

/// A server of the protocol's version 1.0 on a free port of the loopback interface.
class TestServer {
 public:
  json info = {{"protocolVersion", 1.0}, {"models", {"forward", "posterior"}}};
  json support = {{"Evaluate", true}, {"Gradient", false}};
  std::vector<int> input_sizes{1, 2};
  std::vector<int> output_sizes{1};
  std::atomic<int> requests = 0;  // of Evaluate
  /// Answers /Evaluate; by default the sum of all inputs, negative.
  std::function<void(const json& request, httplib::Response& response)> evaluate = answer_sum;

  static void answer_sum(const json& request, httplib::Response& response) {
    double sum = 0.0;
    for (const auto& vector : request["input"]) {
      for (const double x : vector) sum -= x;
    }
    response.set_content(json{{"output", {{sum}}}}.dump(), "application/json");
  }

  TestServer() {
    server_.set_keep_alive_timeout(1);
    server_.new_task_queue = [] { return new httplib::ThreadPool(16); };
    server_.Get("/Info", [this](const auto&, auto& r) { r.set_content(info.dump(), "application/json"); });
    const auto post = [this](const std::string& path, auto answer) {
      server_.Post(path, [this, answer](const httplib::Request& request, httplib::Response& r) {
        const json body = json::parse(request.body);
        const auto names = info["models"].get<std::set<std::string>>();
        if (!names.contains(body["name"].get<std::string>())) {
          r.status = 400;
          r.set_content(R"({"error": {"type": "ModelNotFound", "message": "no such model"}})",
                        "application/json");
          return;
        }
        answer(body, r);
      });
    };
    const auto give = [](const char* key, const auto& value) {
      return [key, &value](const json&, httplib::Response& r) {
        r.set_content(json{{key, value}}.dump(), "application/json");
      };
    };
    post("/ModelInfo", give("support", support));
    post("/InputSizes", give("inputSizes", input_sizes));
    post("/OutputSizes", give("outputSizes", output_sizes));
    server_.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response&) {
      const std::lock_guard lock(mutex_);
      ports_.insert(request.remote_port);
      return httplib::Server::HandlerResponse::Unhandled;
    });
    post("/Evaluate", [this](const json& body, httplib::Response& r) {
      ++requests;
      evaluate(body, r);
    });
    listen(0);
  }
  ~TestServer() { stop(); }

  void stop() {
    server_.stop();
    if (thread_.joinable()) thread_.join();
  }
  void listen(int port) {
    if (port > 0) {
      REQUIRE(server_.bind_to_port("127.0.0.1", port));
      port_ = port;
    } else {
      port_ = server_.bind_to_any_port("127.0.0.1");
    }
    thread_ = std::thread([this] { server_.listen_after_bind(); });
    while (!server_.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  [[nodiscard]] int port() const { return port_; }
  [[nodiscard]] std::size_t connections() {
    const std::lock_guard lock(mutex_);
    return ports_.size();
  }

  [[nodiscard]] models::UmBridgeOptions options() const {
    models::UmBridgeOptions options;
    options.server.url = "http://127.0.0.1:" + std::to_string(port_);
    options.model = "posterior";
    options.parameter_names = {"a", "b", "c"};
    return options;
  }

 private:
  httplib::Server server_;
  std::thread thread_;
  int port_ = 0;
  std::mutex mutex_;
  std::set<int> ports_;  // of the client, one a connection
};

const Eigen::MatrixXd points =
    (Eigen::MatrixXd(3, 3) << 0.1, 0.2, 0.3, 1.0, 2.0, 3.0, -1.0 / 3.0, 1e-300, 7.0).finished();

Eigen::VectorXd values_of(const UmBridge& model) {
  Eigen::VectorXd values(points.rows());
  model(points, values);
  return values;
}

std::string message_of(const UmBridge& model) {
  try {
    values_of(model);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "no error";
}

void answer(httplib::Response& response, const std::string& body, int status = 200) {
  response.status = status;
  response.set_content(body, "application/json");
}

}  // namespace

TEST_CASE("one output is the log-likelihood, and inputs are filled in the order of the parameters",
          "[models][um_bridge]") {
  TestServer server;
  std::mutex mutex;
  std::vector<json> seen;
  server.evaluate = [&](const json& request, httplib::Response& r) {
    const std::lock_guard lock(mutex);
    seen.push_back(request);
    TestServer::answer_sum(request, r);
  };
  auto options = server.options();
  options.config = R"({"level": 2})";
  const Eigen::VectorXd values = values_of(UmBridge(options));
  for (Eigen::Index i = 0; i < 3; ++i) {
    CHECK(values[i] == ((0.0 - points(i, 0)) - points(i, 1)) - points(i, 2));
  }
  REQUIRE(seen.size() == 3);
  CHECK(seen[2] ==
        json{{"name", "posterior"}, {"input", {{-1.0 / 3.0}, {1e-300, 7.0}}}, {"config", {{"level", 2}}}});
}

TEST_CASE("outputs are compared with data by a Gaussian likelihood", "[models][um_bridge]") {
  TestServer server;
  server.output_sizes = {2, 1};
  server.evaluate = [](const json& request, httplib::Response& r) {
    answer(r, json{{"output", {{request["input"][0][0], 2.0}, {request["input"][1][1]}}}}.dump());
  };
  auto options = server.options();
  options.outputs = 3;
  const UmBridge model(options);
  Eigen::VectorXd values(3);
  const auto evaluate = [&](const auto& p, auto outputs) { model.evaluate(p, outputs); };
  models::gaussian_likelihood(evaluate, {{0.0, 2.5, 3.0}, {1.0, 0.5, 2.0}})(points, values);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double chi2 = std::pow(points(i, 0), 2) + 1.0 + std::pow((3.0 - points(i, 2)) / 2.0, 2);
    CHECK(values[i] == Approx(-0.5 * chi2 - 1.5 * std::log(2.0 * M_PI)).epsilon(1e-14));
  }
  options.outputs = 2;
  CHECK_THROWS_WITH(UmBridge(options), Contains("outputs of the sizes [2, 1]: expected 2 in all"));
}

TEST_CASE("minus infinity is a value as Python writes it; other words are no numbers",
          "[models][um_bridge]") {
  TestServer server;
  std::string body = R"({"output": [[-Infinity]]})";
  server.evaluate = [&](const json&, httplib::Response& r) { answer(r, body); };
  const UmBridge model(server.options());
  for (const std::string word : {"-Infinity", "-inf"}) {  // of json.dumps, and of a list as text
    body = R"({"output": [[)" + word + R"(]], "note": "inf, \"nan\" and -inf"})";
    CHECK(values_of(model).maxCoeff() == -std::numeric_limits<double>::infinity());
  }
  for (const std::string word : {"NaN", "nan", "inf", "null", "true", "\"abc\"", "[1]"}) {
    body = R"({"output": [[)" + word + "]]}";
    CHECK_THAT(message_of(model), Contains("expected a number or -Infinity") &&
                                      Contains("; point 1 of 3 (a = 0.1, b = 0.2, c = 0.3)"));
  }
  body = R"({"output": [[null]]})";
  CHECK_THAT(message_of(model), Contains("gave the output null") && Contains("let it give -1e100"));
  for (const std::string word : {"Infinity", "1e400", ""}) {
    body = R"({"output": [[)" + word + "]]}";
    CHECK_THAT(message_of(model), Contains("; point 1 of 3"));
  }
}

TEST_CASE("an answer may come in chunks, with whole numbers, white space and any type of content",
          "[models][um_bridge]") {
  TestServer server;
  server.evaluate = [](const json&, httplib::Response& r) {
    r.set_chunked_content_provider("text/plain", [](std::size_t, httplib::DataSink& sink) {
      for (const std::string part : {"{\"out", "put\":\r\n [ [", "-3", " ] ] }\n\n"}) {
        sink.write(part.data(), part.size());
      }
      sink.done();
      return true;
    });
  };
  CHECK(values_of(UmBridge(server.options())) == Eigen::Vector3d::Constant(-3.0));
  server.info["protocolVersion"] = 1;
  CHECK_NOTHROW(UmBridge(server.options()));
}

TEST_CASE("an error of the model is told in its words, names the point and is not tried again",
          "[models][um_bridge]") {
  TestServer server;
  for (const int status : {200, 400, 500, 503}) {
    server.evaluate = [&](const json& request, httplib::Response& r) {
      if (request["input"][0][0] == 1.0) {
        answer(r, R"({"error": {"type": "InvalidInput", "message": "the mesh is\ntoo coarse"}})", status);
      } else {
        TestServer::answer_sum(request, r);
      }
    };
    server.requests = 0;
    const UmBridge model(server.options());
    CHECK_THAT(message_of(model),
               Contains("model posterior: answered with the error InvalidInput: the mesh is\\ntoo coarse; "
                        "point 2 of 3 (a = 1, b = 2, c = 3)"));
    CHECK(server.requests == 2);
  }
  server.evaluate = [](const json&, httplib::Response& r) { answer(r, "Internal Server Error", 500); };
  CHECK_THAT(message_of(UmBridge(server.options())),
             Contains("status 500 (Internal Server Error): expected 200; point 1 of 3"));
  server.evaluate = [](const json&, httplib::Response&) { throw std::runtime_error("no mesh"); };
  CHECK_THAT(message_of(UmBridge(server.options())),
             Contains("status 500 (no mesh): expected 200; point 1 of 3"));
  server.evaluate = [](const json&, httplib::Response& r) { answer(r, "[1, 2"); };
  CHECK_THAT(message_of(UmBridge(server.options())), Contains("answered '[1, 2': expected a JSON object"));
  server.evaluate = [](const json&, httplib::Response& r) { answer(r, R"({"error": 3})"); };
  CHECK_THAT(message_of(UmBridge(server.options())), Contains("answered with the error"));
}

TEST_CASE("outputs of other sizes than announced are refused with the point", "[models][um_bridge]") {
  TestServer server;
  const UmBridge model(server.options());
  for (const std::string output : {"[[1, 2]]", "[[]]", "[]", "[[1], [2]]", "1", "[1]", "{}"}) {
    server.evaluate = [&](const json&, httplib::Response& r) { answer(r, R"({"output": )" + output + "}"); };
    CHECK_THAT(message_of(model), Contains("expected") && Contains("; point 1 of 3 (a = 0.1"));
  }
  server.evaluate = [&](const json&, httplib::Response& r) { answer(r, R"({"result": [[1]]})"); };
  CHECK_THAT(message_of(model), Contains("expected vectors in 'output'"));
}

TEST_CASE("a server that is not what it should be is refused at once", "[models][um_bridge]") {
  TestServer server;
  const auto refusal = [&](auto change) {
    auto options = server.options();
    change(options);
    try {
      UmBridge model(options);
    } catch (const ModelError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const auto nothing = [](auto&) {};
  CHECK_THAT(refusal([](auto& o) { o.model = "missing"; }),
             Contains(R"(model missing: is not there: expected one of ["forward","posterior"])"));
  CHECK_THAT(refusal([](auto& o) { o.parameter_names = {"a"}; }),
             Contains("inputs of the sizes [1, 2]: expected 1 in all"));
  CHECK_THAT(refusal([](auto& o) { o.server.url += "/elsewhere"; }), Contains("status 404"));
  server.output_sizes = {4};
  CHECK_THAT(refusal(nothing), Contains("outputs of the sizes [4]: expected 1 in all"));
  server.output_sizes = {1};
  server.support = {{"Gradient", true}};
  CHECK_THAT(refusal(nothing), Contains("does not support Evaluate"));
  server.info["protocolVersion"] = 0.9;
  CHECK_THAT(refusal(nothing), Contains("protocol version 0.9: expected 1.0"));
  server.info = {{"models", {"posterior"}}};
  CHECK_THAT(refusal(nothing), Contains("'protocolVersion'"));
  server.stop();
  CHECK_THAT(refusal([](auto& o) { o.server.retries = 1; }), Contains("could not be reached in 2 attempts"));
}

TEST_CASE("options that make no sense are refused", "[models][um_bridge]") {
  TestServer server;
  const auto refuse = [&](auto change) {
    auto options = server.options();
    change(options);
    CHECK_THROWS_AS(UmBridge(options), errors::InvalidValue);
  };
  for (const std::string url : {"", "localhost:80", "https://localhost", "http://", "ftp://x"}) {
    refuse([&](auto& o) { o.server.url = url; });
  }
  refuse([](auto& o) { o.server.retries = -1; });
  refuse([](auto& o) { o.server.timeout_seconds = -1.0; });
  refuse([](auto& o) { o.parameter_names.clear(); });
  refuse([](auto& o) { o.config = "[]"; });
  refuse([](auto& o) { o.config = "{"; });
}

TEST_CASE("an answer that takes too long ends the run, and is not asked for again", "[models][um_bridge]") {
  TestServer server;
  server.evaluate = [](const json& request, httplib::Response& r) {
    std::this_thread::sleep_for(std::chrono::milliseconds(request["input"][0][0] == 1.0 ? 1500 : 0));
    TestServer::answer_sum(request, r);
  };
  auto options = server.options();
  options.server.timeout_seconds = 0.5;
  const UmBridge model(options);
  const auto start = std::chrono::steady_clock::now();
  CHECK_THAT(message_of(model), Contains("took more than 0.5 s; point 2 of 3"));
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::milliseconds(1400));
  CHECK(server.requests == 2);
}

TEST_CASE(
    "a connection that is lost in mid-request is made again, and a gateway without a server is asked again",
    "[models][um_bridge]") {
  TestServer server;
  std::atomic<int> left = 2;
  const bool is_gateway = GENERATE(false, true);
  server.evaluate = [&](const json& request, httplib::Response& r) {
    if (left-- <= 0) {
      TestServer::answer_sum(request, r);
    } else if (is_gateway) {
      answer(r, "<html>503 Service Unavailable</html>", 503);
    } else {  // an answer that ends before its length
      r.set_content_provider(100, "application/json",
                             [](std::size_t, std::size_t, httplib::DataSink&) { return false; });
    }
  };
  const UmBridge model(server.options());
  CHECK(values_of(model)[1] == -6.0);
  CHECK(model.repeated_requests() == 2);
  CHECK(server.requests == 5);
  left = 1000;
  auto options = server.options();
  options.server.retries = 1;
  CHECK_THAT(message_of(UmBridge(options)),
             Contains("could not be reached in 2 attempts") && Contains("; point 1 of 3"));
}

TEST_CASE("a connection is kept for the next point, and closed when no point comes", "[models][um_bridge]") {
  TestServer server;
  const UmBridge model(server.options());
  const Eigen::MatrixXd many = Eigen::MatrixXd::Random(20, 3);
  Eigen::VectorXd values(20);
  model(many, values);
  CHECK(server.connections() <= 12);  // of 24 requests; the server closes each after five
  const std::size_t before = server.connections();
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  model(many.topRows(1), values.head(1));
  CHECK(server.connections() == before + 1);
  CHECK(model.repeated_requests() == 0);
}

TEST_CASE("a server that is started again is found again", "[models][um_bridge]") {
  auto server = std::make_unique<TestServer>();
  const int port = server->port();
  const UmBridge model(server->options());
  const Eigen::VectorXd before = values_of(model);
  server->stop();
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    server->listen(port);
  });
  CHECK(values_of(model) == before);
  later.join();
  CHECK(model.repeated_requests() >= 1);
}

TEST_CASE("eight requests are on their way at a time", "[models][um_bridge]") {
  TestServer server;
  std::atomic<int> running = 0;
  std::atomic<int> most = 0;
  server.evaluate = [&](const json& request, httplib::Response& r) {
    const int now = ++running;
    for (int seen = most; seen < now && !most.compare_exchange_weak(seen, now);) {
    }
    for (int waited = 0; most < 8 && waited < 1000; ++waited) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    --running;
    TestServer::answer_sum(request, r);
  };
  const auto model = models::parallel_batches(UmBridge(server.options()), {8, 1});
  const Eigen::MatrixXd many = Eigen::MatrixXd::Random(32, 3);
  Eigen::VectorXd values(32);
  model(many, values);
  for (Eigen::Index i = 0; i < 32; ++i) {
    CHECK(values[i] == ((0.0 - many(i, 0)) - many(i, 1)) - many(i, 2));
  }
  CHECK(most == 8);
}
