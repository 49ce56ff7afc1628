#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "io/files.hpp"
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
