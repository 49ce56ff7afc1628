#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>

#include "io/csv.hpp"
#include "io/files.hpp"
#include "io/interrupt.hpp"
#include "io/progress.hpp"
#include "temporary_directory.hpp"

namespace fs = std::filesystem;

namespace {

constexpr int untouched = 7;    // exit status of a body that came to its end
constexpr double soon_s = 2.5;  // a second, on a machine with other work

struct End {
  int status;
  double seconds;
};

/// Runs the body in a process of its own, as a main does: what it throws ends the process by the
/// signal. Signals have their default actions before.
End end_of(const std::function<void()>& body) {
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    for (const int signal_number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXCPU, SIGXFSZ, SIGABRT}) {
      ::signal(signal_number, SIG_DFL);
    }
    try {
      io::catch_interrupts();
      body();
    } catch (const io::Interrupted&) {
      io::die_of_interrupt();
    } catch (const std::exception&) {
      ::_exit(1);
    }
    ::_exit(untouched);
  }
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  return {status, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
}

int signal_of(const End& end) {
  return WIFSIGNALED(end.status) ? WTERMSIG(end.status) : 0;
}

/// Sends the signal to this process while the caller waits for something.
class SoonInterrupted {
 public:
  explicit SoonInterrupted(int signal_number)
      : thread_([signal_number] {
          std::this_thread::sleep_for(std::chrono::milliseconds(100));
          ::kill(::getpid(), signal_number);
        }) {}
  ~SoonInterrupted() { thread_.join(); }

 private:
  std::thread thread_;
};

}  // namespace

TEST_CASE("an interrupt is thrown where the work looks for it, and ends the process by the signal",
          "[io][interrupt]") {
  const TemporaryDirectory directory;
  std::ofstream(directory.path() / "old") << "old";
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXCPU}) {
    const End end = end_of([&] {
      io::OutputFile fresh(directory.path() / "new");
      io::OutputFile replaced(directory.path() / "old");
      io::OutputFile prepared(directory.path() / "prepared");
      io::OutputFile done(directory.path() / "done");
      replaced.write("x");
      prepared.prepare();
      done.commit();
      io::stop_if_interrupted();
      if (io::interrupt_signal() != 0) ::_exit(2);
      ::raise(signal_number);
      if (io::interrupt_signal() != signal_number) ::_exit(3);
      io::stop_if_interrupted();
    });
    CAPTURE(signal_number, end.status);
    CHECK(signal_of(end) == signal_number);
    CHECK(content(directory.path() / "old") == "old");
    CHECK(fs::remove(directory.path() / "done"));
    CHECK(std::distance(fs::directory_iterator(directory.path()), {}) == 1);
  }
}

TEST_CASE("the first of several signals counts", "[io][interrupt]") {
  const int pairs[][2] = {
      {SIGINT, SIGTERM}, {SIGTERM, SIGHUP}, {SIGTERM, SIGINT}, {SIGHUP, SIGPIPE}, {SIGTERM, SIGTERM}};
  for (const auto& [first, second] : pairs) {
    const End end = end_of([&, first = first, second = second] {
      ::raise(first);
      ::raise(second);
      io::stop_if_interrupted();
    });
    CAPTURE(first, second, end.status);
    CHECK(signal_of(end) == first);
    CHECK(end.seconds < soon_s);
  }
}

TEST_CASE("a message into a broken pipe changes nothing", "[io][interrupt]") {
  const End end = end_of([] {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) ::_exit(2);
    ::close(ends[0]);
    ::raise(SIGTERM);
    if (::write(ends[1], "interrupted\n", 12) >= 0) ::_exit(3);
    io::stop_if_interrupted();
  });
  CHECK(signal_of(end) == SIGTERM);
  CHECK(end.seconds < soon_s);
}

TEST_CASE("work that does not look is ended all the same, and leaves no file", "[io][interrupt]") {
  const TemporaryDirectory directory;
  const End end = end_of([&] {
    io::OutputFile file(directory.path() / "new");
    file.write(std::string(1000000, 'x'));
    ::raise(SIGTERM);
    for (;;) ::pause();
  });
  CHECK(signal_of(end) == SIGTERM);
  CHECK(end.seconds > 0.5);
  CHECK(end.seconds < soon_s);
  CHECK(fs::is_empty(directory.path()));
}

TEST_CASE("a kill and a crash leave no file either", "[io][interrupt]") {
  const TemporaryDirectory directory;
  for (const int signal_number : {SIGKILL, SIGABRT}) {
    const End end = end_of([&] {
      io::OutputFile file(directory.path() / "new");
      file.write(std::string(1000000, 'x'));
      ::raise(signal_number);
    });
    CHECK(signal_of(end) == signal_number);
    CHECK(fs::is_empty(directory.path()));
  }
}

TEST_CASE("signals that were ignored stay ignored", "[io][interrupt]") {
  const End end = end_of([] {
    ::signal(SIGHUP, SIG_IGN);
    io::catch_interrupts();
    ::raise(SIGHUP);
    io::stop_if_interrupted();
  });
  CHECK(WEXITSTATUS(end.status) == untouched);
}

TEST_CASE("waiting for the other end of a pipe is broken off", "[io][interrupt]") {
  const TemporaryDirectory directory;
  const fs::path fifo = directory.path() / "fifo";
  REQUIRE(::mkfifo(fifo.c_str(), 0600) == 0);
  const auto check = [&](const char* what, const std::function<void()>& body) {
    const End end = end_of(body);
    CAPTURE(what, end.status);
    CHECK(signal_of(end) == SIGTERM);
    CHECK(end.seconds < 0.9);  // noticed, and not ended from outside
  };
  check("an output without a reader", [&] {
    const SoonInterrupted soon(SIGTERM);
    const io::OutputFile file(fifo);
  });
  check("a signal that came before", [&] {
    ::raise(SIGTERM);
    const io::OutputFile file(fifo);
  });
  check("an output whose reader does not read", [&] {
    const int reader = ::open(fifo.c_str(), O_RDONLY | O_NONBLOCK);
    if (reader < 0) ::_exit(2);
    io::OutputFile file(fifo);
    const SoonInterrupted soon(SIGTERM);
    for (;;) file.write(std::string(1000000, 'x'));
  });
  check("an input whose writer does not write", [&] {
    const int writer = ::open(fifo.c_str(), O_RDWR);
    if (writer < 0) ::_exit(2);
    const SoonInterrupted soon(SIGTERM);
    static_cast<void>(io::CsvTable::read(fifo));
  });
}

TEST_CASE("a step of the progress is a place to be interrupted", "[io][interrupt][progress]") {
  const End end = end_of([] {
    io::Progress progress("runs", 3, false);
    progress.advance();
    ::raise(SIGINT);
    progress.advance();
    ::_exit(2);
  });
  CHECK(signal_of(end) == SIGINT);
}

TEST_CASE("a file beyond the limit of its size is a failed write", "[io][interrupt][files]") {
  const TemporaryDirectory directory;
  const End end = end_of([&] {
    const rlimit limit{10000, 10000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    io::OutputFile file(directory.path() / "new");
    try {
      for (int i = 0; i < 1000; ++i) file.write(std::string(1000, 'x'));
      file.commit();
    } catch (const io::OutputError& error) {
      ::_exit(std::string(error.what()).find("File too large") == std::string::npos ? 3 : 4);
    }
  });
  CHECK(WIFEXITED(end.status));
  CHECK(WEXITSTATUS(end.status) == 4);
  CHECK(fs::is_empty(directory.path()));
}
