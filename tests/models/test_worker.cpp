#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "errors/invalid_value.hpp"
#include "io/interrupt.hpp"
#include "io/temporary_directory.hpp"
#include "models/lifeline.hpp"
#include "models/model_error.hpp"
#include "models/parallel_batches.hpp"
#include "models/worker.hpp"

using Catch::Matchers::Contains;
using models::ModelError;
using models::Worker;
namespace fs = std::filesystem;

namespace {

/// A program with two parameters, a and b.
class Script {
 public:
  explicit Script(const std::string& text) {
    std::ofstream(path()) << text;
    fs::permissions(path(), fs::perms::owner_all);
  }
  [[nodiscard]] fs::path path() const { return directory_.path() / "worker"; }
  [[nodiscard]] fs::path file(const std::string& name) const { return directory_.path() / name; }
  [[nodiscard]] Worker worker(double timeout_seconds = 0.0) const {
    return Worker({path().string(), {"a", "b"}, timeout_seconds});
  }

 private:
  TemporaryDirectory directory_;
};

/// A worker in shell: $batch answers the $n points that follow.
std::string shell(const std::string& batch) {
  return "#!/bin/sh\nwhile read -r n; do\n" + batch + "\ndone\n";
}
const std::string each_minus_a =
    "i=0; while [ $i -lt $n ]; do IFS=, read -r a b; echo -$a; i=$((i + 1)); done";

Eigen::MatrixXd some_points(Eigen::Index n) {
  Eigen::MatrixXd points(n, 2);
  for (Eigen::Index i = 0; i < n; ++i) {
    points.row(i) << 0.5 + static_cast<double>(i), 1.0 / 3.0;
  }
  return points;
}

Eigen::VectorXd values_of(const Worker& worker, const Eigen::MatrixXd& points) {
  Eigen::VectorXd values(points.rows());
  worker(points, values);
  return values;
}

}  // namespace

TEST_CASE("a worker answers batch after batch and is started once", "[models][worker]") {
  const Script script("#!/bin/sh\necho \"$@\" >>\"${0%/*}/starts\"\n" + shell(each_minus_a).substr(10));
  {
    const Worker worker = script.worker();
    for (const Eigen::Index n : {1, 5, 300}) {
      const Eigen::MatrixXd points = some_points(n);
      CHECK(values_of(worker, points) == -points.col(0));
    }
    CHECK(values_of(worker, some_points(0)).size() == 0);
    CHECK(worker.restarts() == 0);
  }
  CHECK(content(script.file("starts")) == "a b\n");
}

TEST_CASE("a worker gets every digit, and minus infinity is a value", "[models][worker]") {
  const Script script(
      "#!/usr/bin/env python3\n"
      "import sys\n"
      "for n in sys.stdin:\n"
      "    rows = [[float(x) for x in sys.stdin.readline().split(',')] for _ in range(int(n))]\n"
      "    print('\\r\\n'.join('-inf' if b < 0 else repr(a) for a, b in rows), flush=True)\n");
  Eigen::MatrixXd points(4, 2);
  points << std::nextafter(0.1, 1.0), 1.0, -1.0 / 3.0, 0.0, 5e-324, 1.0, 7.0, -1.0;
  const Eigen::VectorXd values = values_of(script.worker(), points);
  CHECK(values.head(3) == points.col(0).head(3));
  CHECK(values[3] == -std::numeric_limits<double>::infinity());
}

TEST_CASE("batches larger than a pipe come through whether a worker reads all first or not",
          "[models][worker]") {
  const Eigen::MatrixXd points = some_points(20000);
  const std::string begin = "#!/usr/bin/env python3\nimport sys\nfor n in sys.stdin:\n    ";
  const std::string line = "sys.stdin.readline().split(',')[0]";
  const Script reads_all(begin + "print(*[" + line + " for _ in range(int(n))], sep='\\n', flush=True)\n");
  const Script line_by_line(begin + "for _ in range(int(n)): print(" + line + ", flush=True)\n");
  for (const Script* script : {&reads_all, &line_by_line}) {
    const Worker worker = script->worker(30.0);
    CHECK(values_of(worker, points) == points.col(0));
    CHECK(values_of(worker, points) == points.col(0));
    CHECK(worker.restarts() == 0);
  }
}

TEST_CASE("a worker that dies is started again, and that is told and counted", "[models][worker]") {
  const Script script(
      shell(each_minus_a + "; [ -e \"${0%/*}/died\" ] || { >\"${0%/*}/died\"; kill -SEGV $$; }"));
  const Script in_batch(
      shell("[ -e \"${0%/*}/died\" ] || { >\"${0%/*}/died\"; echo -1; exit 7; }\n" + each_minus_a));
  std::mutex mutex;
  std::vector<std::string> told;
  const auto on_restart = [&](const std::string& reason) {
    const std::lock_guard lock(mutex);
    told.push_back(reason);
  };
  const Eigen::MatrixXd points = some_points(3);
  const Worker between({script.path().string(), {"a", "b"}, 0.0, on_restart});
  CHECK(values_of(between, points) == -points.col(0));
  while (!fs::exists(script.file("died"))) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  CHECK(values_of(between, points) == -points.col(0));
  CHECK(between.restarts() == 1);
  const Worker inside({in_batch.path().string(), {"a", "b"}, 0.0, on_restart});
  CHECK(values_of(inside, points) == -points.col(0));
  CHECK(inside.restarts() == 1);
  REQUIRE(told.size() == 2);
  CHECK_THAT(told[0], Contains("was ended by signal 11") && Contains("started again"));
  CHECK_THAT(told[1], Contains("ended with status 7"));
}

TEST_CASE("a worker that fails is named with what it did and with the point", "[models][worker]") {
  const auto message = [](const std::string& text, double timeout_seconds = 30.0) {
    const Script script(text);
    try {
      values_of(script.worker(timeout_seconds), some_points(3));
    } catch (const ModelError& error) {
      CHECK_THAT(error.what(), Contains(script.path().string().substr(0, 60)));
      return std::string(error.what());
    }
    return std::string("no error");
  };
  CHECK_THAT(
      message(shell("echo -1; exit 3")),
      Contains("ended with status 3: expected 0 after 1 of 3 log-likelihoods, as did the worker before it; "
               "point 2 of 3 (a = 1.5, b = 0.3333333333333333)"));
  CHECK_THAT(message(shell("kill -KILL $$")),
             Contains("signal 9") && Contains("the first of 3 points (a = 0.5"));
  CHECK_THAT(message(shell("exit 0")), Contains("ended with status 0: expected it to go on"));
  CHECK_THAT(message(shell("sleep 60 & sleep 60"), 0.2),
             Contains("took more than 0.2 s and was killed after 0 of 3") && Contains("a = 0.5"));
  CHECK_THAT(message(shell("echo -1; echo -2; exec >&-; sleep 60")),
             Contains("closed its standard input or output"));
  CHECK_THAT(message(shell("exec <&-; sleep 60"), 0.5),
             Contains("took more") || Contains("closed its standard input"));
  CHECK_THAT(message("#!/bin/sh\necho ready\n" + shell(each_minus_a).substr(10)), Contains("'ready'"));
  for (const std::string value : {"nan", "inf", "+inf", "1e400", "abc", "", "1 2", "0x10"}) {
    CHECK_THAT(message(shell("echo -1; echo -1; echo '" + value + "'; sleep 60")),
               Contains("wrote the log-likelihood '" + value +
                        "': expected a number or -inf; point 3 of 3 (a = 2.5"));
  }
  CHECK_THAT(message(shell("printf '%s\\n' -1 -1 -1 -4; sleep 60")),
             Contains("wrote '-4' after the last of 3 log-likelihoods; point 3 of 3"));
  CHECK_THAT(message("#!/bin/sh\nwhile :; do printf xxxxxxxxxxxxxxxx; done\n"),
             Contains("a line of more than 4096 bytes") || Contains("before it was given points"));
  CHECK_THAT(message("#! /no/such/interpreter\n"), Contains("could not be started: the interpreter"));
}

TEST_CASE("a line that no point asked for is seen before the next batch", "[models][worker]") {
  const Script script(shell(each_minus_a + "; sleep 0.1; echo -9; >\"${0%/*}/written\""));
  const Worker worker = script.worker();
  values_of(worker, some_points(2));
  while (!fs::exists(script.file("written"))) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  CHECK_THROWS_WITH(values_of(worker, some_points(2)), Contains("wrote '-9' before it was given points"));
}

TEST_CASE("calls at a time have a worker each, and all end with the last copy", "[models][worker]") {
  const Script script("#!/bin/sh\necho x >>\"${0%/*}/starts\"\n" +
                      shell("sleep 0.05; " + each_minus_a).substr(10));
  Lifeline lifeline;
  {
    const auto parallel = models::parallel_batches(script.worker(), {4, 2});
    const Eigen::MatrixXd points = some_points(16);
    Eigen::VectorXd values(16);
    parallel(points, values);
    CHECK(values == -points.col(0));
  }
  CHECK(content(script.file("starts")) == "x\nx\nx\nx\n");
  CHECK(lifeline.all_have_ended());
}

TEST_CASE("an interrupt kills the groups of the workers within a second", "[models][worker]") {
  const Script script(shell("trap '' TERM INT HUP; sleep 30 & sleep 30"));
  Lifeline lifeline;
  const pid_t process = ::fork();
  REQUIRE(process >= 0);
  if (process == 0) {
    ::signal(SIGTERM, SIG_DFL);
    io::catch_interrupts();
    std::thread signal([] {
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      ::kill(::getpid(), SIGTERM);
    });
    int status = 1;
    try {
      values_of(script.worker(), some_points(3));
    } catch (const io::Interrupted&) {
      status = 0;
    }
    signal.join();
    ::_exit(status);
  }
  int status = 0;
  REQUIRE(::waitpid(process, &status, 0) == process);
  CHECK(status == 0);
  CHECK(lifeline.all_have_ended());
}

TEST_CASE("options and batches of another shape are refused", "[models][worker]") {
  const Script script(shell(each_minus_a));
  CHECK_THROWS_AS(Worker({script.path().string(), {}}), errors::InvalidValue);
  CHECK_THROWS_AS(Worker({script.path().string(), {"a"}, -1.0}), errors::InvalidValue);
  CHECK_THROWS_WITH(Worker({"/no/such/program", {"a"}}), Contains("expected a program that can be run"));
  Eigen::VectorXd values(2);
  CHECK_THROWS_AS(script.worker()(Eigen::MatrixXd::Zero(2, 3), values), errors::InvalidValue);
}
