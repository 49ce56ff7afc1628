#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <string>
#include <thread>

#include "io/interrupt.hpp"
#include "io/temporary_directory.hpp"
#include "models/child.hpp"
#include "models/lifeline.hpp"

using models::ChildEnd;
namespace fs = std::filesystem;

namespace {

ChildEnd run_shell(const std::string& script, double timeout_seconds = 0.0,
                   const std::string& directory = "/") {
  return models::run_child({"/bin/sh", "-c", script}, directory, timeout_seconds);
}

}  // namespace

TEST_CASE("a child ends by itself, by a signal, or was never begun", "[models][child]") {
  const ChildEnd done = run_shell("exit 3");
  CHECK(done.kind == ChildEnd::Kind::exited);
  CHECK(done.value == 3);
  const ChildEnd crashed = run_shell("kill -SEGV $$");
  CHECK(crashed.kind == ChildEnd::Kind::signalled);
  CHECK(crashed.value == SIGSEGV);
  const ChildEnd missing = models::run_child({"/none/such"}, "/", 0.0);
  CHECK(missing.kind == ChildEnd::Kind::not_started);
  CHECK(missing.value == ENOENT);
  const TemporaryDirectory directory;
  const fs::path text = directory.path() / "no_first_line";
  std::ofstream(text) << "echo\n";
  fs::permissions(text, fs::perms::owner_all);
  const ChildEnd unknown = models::run_child({text.string()}, "/", 0.0);
  CHECK(unknown.kind == ChildEnd::Kind::not_started);
  CHECK(unknown.value == ENOEXEC);
}

TEST_CASE("a child starts in its directory, with nothing to read and with default signals",
          "[models][child]") {
  const TemporaryDirectory directory;
  io::catch_interrupts();  // ignores SIGXFSZ
  const ChildEnd end = run_shell("pwd -P >where; cat >read; grep SigIgn /proc/self/status >ignored", 0.0,
                                 directory.path().string());
  CHECK(end.value == 0);
  CHECK(content(directory.path() / "where") == fs::canonical(directory.path()).string() + "\n");
  CHECK(content(directory.path() / "read").empty());
  const auto ignored = std::stoull(content(directory.path() / "ignored").substr(8), nullptr, 16);
  CHECK((ignored >> (SIGXFSZ - 1) & 1U) == 0U);
}

TEST_CASE("when the time is over the whole group is killed", "[models][child]") {
  Lifeline lifeline;
  const auto start = std::chrono::steady_clock::now();
  const ChildEnd end = run_shell("sleep 30 & sleep 30", 0.3);
  CHECK(end.kind == ChildEnd::Kind::timed_out);
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(5));
  CHECK(lifeline.all_have_ended());
}

TEST_CASE("what a child has left running ends with it", "[models][child]") {
  Lifeline lifeline;
  const ChildEnd end = run_shell("sleep 30 & exit 0");
  CHECK(end.kind == ChildEnd::Kind::exited);
  CHECK(lifeline.all_have_ended());
}

TEST_CASE("an interrupt kills the groups of all threads and is thrown", "[models][child]") {
  for (const bool ignores_signals : {false, true}) {
    Lifeline lifeline;
    const pid_t process = ::fork();
    REQUIRE(process >= 0);
    if (process == 0) {
      ::signal(SIGTERM, SIG_DFL);
      io::catch_interrupts();
      const auto run = [&] {
        try {
          static_cast<void>(run_shell(ignores_signals ? "trap '' TERM INT HUP; sleep 30 & sleep 30"
                                                      : "sleep 30 & sleep 30"));
        } catch (const io::Interrupted&) {
          return;
        }
        ::_exit(1);
      };
      std::thread other(run);
      std::thread signal([] {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        ::kill(::getpid(), SIGTERM);
      });
      run();
      other.join();
      signal.join();
      ::_exit(0);
    }
    int status = 0;
    REQUIRE(::waitpid(process, &status, 0) == process);
    CHECK(status == 0);
    CHECK(lifeline.all_have_ended());
  }
}
