#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "io/files.hpp"
#include "io/process_groups.hpp"
#include "io/signals.hpp"
#include "temporary_directory.hpp"

using io::OutputFile;
namespace fs = std::filesystem;

namespace {

std::size_t entries(const fs::path& directory) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(directory), fs::directory_iterator()));
}

/// Runs the body in a child process, standard error going to the file, and gives the child's wait status.
int status_of_child(const fs::path& standard_error, const std::function<void()>& body) {
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    ::dup2(::open(standard_error.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
    body();
    ::_exit(7);
  }
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  return status;
}

/// Starts a group whose leader and its child hold the writing end of a pipe until they end.
void start_group(int pipe_end) {
  const pid_t leader = io::fork_group();
  if (leader != 0) return;
  static_cast<void>(::fork());
  ::alarm(30);  // if nobody kills it
  [[maybe_unused]] const ssize_t ignored = ::write(pipe_end, "x", 1);
  for (;;) ::pause();
}

/// Whether all others that hold the other end of the pipe end within ten seconds.
bool all_end(int pipe_end) {
  char byte = 0;
  pollfd waiting{pipe_end, POLLIN, 0};
  while (::poll(&waiting, 1, 10000) > 0) {
    if (::read(pipe_end, &byte, 1) <= 0) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("signals that end the process remove the temporary files and say what is kept", "[io][signals]") {
  const TemporaryDirectory directory;
  const TemporaryDirectory other;
  const fs::path said = other.path() / "stderr";
  std::ofstream(directory.path() / "old") << "old";
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP, SIGXFSZ}) {
    const int status = status_of_child(said, [&] {
      ::signal(signal_number, SIG_DFL);
      io::end_cleanly_on_signals("program");
      std::vector<std::unique_ptr<OutputFile>> files;
      for (const char* name : {"a", "b", "old", "done"}) {
        files.push_back(std::make_unique<OutputFile>(directory.path() / name));
        files.back()->write("x");
      }
      files.back()->commit();
      if (entries(directory.path()) != 5) ::_exit(1);
      ::raise(signal_number);
    });
    CAPTURE(signal_number, status);
    CHECK(WIFSIGNALED(status));
    CHECK(WTERMSIG(status) == signal_number);
    CHECK(entries(directory.path()) == 2);
    CHECK(content(directory.path() / "old") == "old");
    CHECK(content(said) == "program: interrupted: no unfinished output is kept\n");
    fs::remove(directory.path() / "done");
  }
}

TEST_CASE("the last note before the signal is the one that is said", "[io][signals]") {
  const TemporaryDirectory directory;
  const fs::path said = directory.path() / "stderr";
  const auto said_after = [&](const std::vector<std::string>& notes) {
    const int status = status_of_child(said, [&] {
      ::signal(SIGINT, SIG_DFL);
      io::set_interruption_note("too early");
      io::end_cleanly_on_signals("program");
      for (const std::string& note : notes) io::set_interruption_note(note);
      ::raise(SIGINT);
    });
    CHECK(WIFSIGNALED(status));
    return content(said);
  };
  CHECK(said_after({"1 of 3 kept"}) == "program: interrupted: 1 of 3 kept\n");
  CHECK(said_after({"1 of 3 kept", "2 of 3 kept", "3 of 3 kept"}) == "program: interrupted: 3 of 3 kept\n");
  CHECK(said_after({"1 of 3 kept", ""}) == "program: interrupted: no unfinished output is kept\n");
  const std::string endless = said_after({std::string(100000, 'x')});
  CHECK(endless.size() < 10000);
  CHECK(endless.find('\n') == endless.size() - 1);
}

TEST_CASE("nothing is said about a closed pipe", "[io][signals]") {
  const TemporaryDirectory directory;
  const fs::path said = directory.path() / "stderr";
  const int status = status_of_child(said, [] {
    ::signal(SIGPIPE, SIG_DFL);
    io::end_cleanly_on_signals("program");
    ::raise(SIGPIPE);
  });
  CHECK(WIFSIGNALED(status));
  CHECK(WTERMSIG(status) == SIGPIPE);
  CHECK(content(said).empty());
}

TEST_CASE("signals that were ignored stay ignored", "[io][signals]") {
  const TemporaryDirectory directory;
  const int status = status_of_child(directory.path() / "stderr", [] {
    ::signal(SIGHUP, SIG_IGN);
    io::end_cleanly_on_signals("program");
    ::raise(SIGHUP);
  });
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 7);
}

TEST_CASE("signals and exit end the process groups too, grandchildren as well", "[io][signals]") {
  const TemporaryDirectory directory;
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP, 0}) {
    int ends[2];
    REQUIRE(::pipe2(ends, O_CLOEXEC) == 0);
    const int status = status_of_child(directory.path() / "stderr", [&] {
      ::close(ends[0]);
      ::signal(signal_number, SIG_DFL);
      io::end_cleanly_on_signals("program");
      start_group(ends[1]);
      start_group(ends[1]);
      ::usleep(50000);
      if (signal_number == 0) std::exit(3);
      ::raise(signal_number);
    });
    ::close(ends[1]);
    CAPTURE(signal_number, status);
    CHECK((signal_number == 0 ? WIFEXITED(status) : WIFSIGNALED(status)));
    CHECK(all_end(ends[0]));
    ::close(ends[0]);
  }
}

TEST_CASE("a group ends with its leader's status, and the next ones have room", "[io][signals]") {
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SLOW_FORKS  // 15 ms each: too few then to fill the room, were it not given back
#endif
#endif
#ifdef SLOW_FORKS
  constexpr int groups = 300;
#else
  constexpr int groups = 5000;
#endif
  for (int i = 0; i < groups; ++i) {
    const pid_t leader = io::fork_group();
    if (leader == 0) ::_exit(3);
    REQUIRE(leader > 0);
    if (i > 0) {  // killed, unless it was faster
      const int status = io::end_group(leader);
      REQUIRE((WIFSIGNALED(status) || WEXITSTATUS(status) == 3));
      continue;
    }
    siginfo_t info;
    REQUIRE(::waitid(P_PID, static_cast<id_t>(leader), &info, WEXITED | WNOWAIT) == 0);
    CHECK(WEXITSTATUS(io::end_group(leader)) == 3);
  }
}

TEST_CASE("exit removes the temporary files and says nothing", "[io][signals]") {
  const TemporaryDirectory directory;
  const TemporaryDirectory other;
  const fs::path said = other.path() / "stderr";
  const int status = status_of_child(said, [&] {
    io::end_cleanly_on_signals("program");
    OutputFile file(directory.path() / "a");
    file.write("x");
    std::exit(3);
  });
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 3);
  CHECK(entries(directory.path()) == 0);
  CHECK(content(said).empty());
}

TEST_CASE("a forked process says nothing and removes nothing of its parent's", "[io][signals]") {
  const TemporaryDirectory directory;
  const TemporaryDirectory other;
  const fs::path said = other.path() / "stderr";
  for (const int signal_number : {SIGINT, 0}) {
    const int status = status_of_child(said, [&] {
      ::signal(SIGINT, SIG_DFL);
      io::end_cleanly_on_signals("program");
      OutputFile file(directory.path() / "a");
      const pid_t child = ::fork();
      if (child == 0) {
        if (signal_number == 0) std::exit(3);
        ::raise(signal_number);
        ::_exit(4);
      }
      int end = 0;
      ::waitpid(child, &end, 0);
      if (signal_number == 0 ? WEXITSTATUS(end) != 3 : !WIFSIGNALED(end)) ::_exit(1);
      file.commit();
      ::_exit(0);
    });
    CAPTURE(signal_number);
    CHECK(status == 0);
    CHECK(entries(directory.path()) == 1);
    CHECK(content(said).empty());
    fs::remove(directory.path() / "a");
  }
}
