#include "command_line/report.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <new>
#include <string_view>

#include "command_line/build_info.hpp"
#include "io/interrupt.hpp"

namespace command_line {

namespace {

bool is_anything_said = true;  // of one process; false in ranks that do not speak

/// A file that is opened later must not get the number of a standard stream
/// that the caller has closed: what is printed would go into it. Writing to
/// standard output and error fails as before.
void keep_standard_descriptors() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) < 0) {
      ::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    }
  }
}

[[noreturn]] void refuse_empty(const std::string& option) {
  throw std::invalid_argument(fmt::format("{}: value '': expected a value (see --help)", option));
}

/// CLI11 would take the next word for the value.
void refuse_empty_values(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view word(argv[i]);
    if (word.starts_with("--") && word.ends_with('=')) {
      refuse_empty(std::string(word.substr(0, word.size() - 1)));
    }
  }
}

/// A file that an option names, or one in a directory that an option names.
struct File {
  std::string path, owner;
  bool is_written;
};

/// \throws std::invalid_argument for an option with an empty value.
std::vector<File> files_of(const CLI::App& app) {
  std::vector<File> files;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_items_expected_max() > 0 && option->count() > 0 && option->results().back().empty()) {
      refuse_empty(option->get_name());
    }
    const std::string type = option->get_type_name();
    const std::string value = option->count() > 0 ? option->results().back() : option->get_default_str();
    if ((type == "FILE" || type == "CSV" || type == "PROGRAM" || type == "TOML") && !value.empty()) {
      files.push_back({value, option->get_name(), type == "FILE"});
    } else if (type == "DIR") {
      std::error_code ignored;
      for (const auto& entry : std::filesystem::directory_iterator(value, ignored)) {
        files.push_back({entry.path(), option->get_name(), false});
      }
    }
  }
  return files;
}

/// Refuses to write a file that is read, or written by another option.
void require_separate(const std::vector<File>& files) {
  for (const File& written : files) {
    for (const File& other : files) {
      if (written.is_written && &written != &other && io::is_same_output(written.path, other.path)) {
        throw std::invalid_argument(fmt::format("{}: value '{}': expected another file than that of {}",
                                                written.owner, io::printable(written.path, 200),
                                                other.owner));
      }
    }
  }
}

/// One line on standard error.
void say(const std::string& line) {
  if (is_anything_said) {
    std::fwrite(line.data(), 1, line.size(), stderr);
  }
}

}  // namespace

Report::Report(CLI::App& app) : app_(app) {
  app.set_version_flag("--version", fmt::format("{} {}", app.get_name(), version()));
  app.get_formatter()->column_width(36);
  app.option_defaults()->always_capture_default();
  app.add_flag("--quiet", is_quiet_, "Print no report and show no progress");
  app.add_flag("--show-options", shows_options_, "Print every option with its value, defaults too, and end")
      ->configurable(false);
}

void Report::be_silent() {
  is_silent_ = true;
  is_anything_said = false;
}

void Report::print(std::string text) const {
  const auto is_control = [](char c) { return (c >= 0 && c < ' ' && c != '\n') || c == 0x7f; };
  std::replace_if(text.begin(), text.end(), is_control, '?');
  std::fwrite(text.data(), 1, text.size(), writes_to_stdout_ ? stderr : stdout);
}

int Report::run(int argc, char** argv, const std::function<void()>& body) {
  keep_standard_descriptors();
  io::catch_interrupts();
  io::Interrupted interrupted;
  int status = 0;
  try {
    status = run_to_end(argc, argv, body);
  } catch (const io::Interrupted& caught) {
    interrupted = caught;
  }
  if (io::interrupt_signal() == 0) {
    return status;
  }
  if (io::interrupt_signal() != SIGPIPE) {  // whoever closed the pipe knows
    say(fmt::format("{}: interrupted: {}\n", app_.get_name(), interrupted.kept));
  }
  io::die_of_interrupt();
}

int Report::run_to_end(int argc, char** argv, const std::function<void()>& body) {
  const auto fail = [&](int status, const std::string& message) {
    if (io::interrupt_signal() == 0) {               // else a system call that was broken off
      constexpr std::size_t longest_message = 8192;  // more than the longest path
      say(fmt::format("{}: error: {}\n", app_.get_name(), io::printable(message, longest_message)));
    }
    return status;
  };
  try {
    refuse_empty_values(argc, argv);
    app_.parse(argc, argv);
    const auto files = files_of(app_);
    require_separate(files);
    writes_to_stdout_ = std::any_of(files.begin(), files.end(),
                                    [](const File& file) { return file.is_written && file.path == "-"; });
    if (shows_options_) {
      fmt::print("{}", is_silent_ ? "" : app_.config_to_str(true));
    } else {
      body();
    }
  } catch (const CLI::Success& request) {  // --help, --version
    if (!is_silent_) {
      app_.exit(request);
    }
  } catch (const CLI::ParseError& error) {
    const std::string message = error.what();
    return fail(2, message.substr(0, message.find('\n')) + " (see --help)");
  } catch (const io::InputError& error) {
    return fail(2, error.what());
  } catch (const io::OutputError& error) {
    return fail(2, error.what());
  } catch (const std::invalid_argument& error) {
    return fail(2, error.what());
  } catch (const tmcmc::InfeasiblePriorError& error) {
    return fail(2, error.what());
  } catch (const std::bad_alloc&) {
    return fail(1, "not enough memory: expected fewer samples, runs or points");
  } catch (const std::exception& error) {
    return fail(1, error.what());
  }
  if (writes_to_stdout_ && std::ferror(stderr) != 0) {
    return 2;
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    return fail(2, fmt::format("standard output: {}: expected to write the report", std::strerror(errno)));
  }
  return 0;
}

void warn(const std::string& text) {
  say(fmt::format("warning: {}\n", text));
}

CLI::Option* add_output(CLI::App& app, const std::string& option, std::string& path,
                        const std::string& description) {
  return app.add_option(option, path, description)->type_name("FILE");
}

CLI::Option* add_output(CLI::App& app, std::string& path, const std::string& description) {
  return add_output(app, "--output", path,
                    description + "; '-' is standard output. Without it no file is written");
}

CLI::Option* add_input(CLI::App& app, const std::string& option, std::string& path,
                       const std::string& description) {
  return app.add_option(option, path, description)->type_name("CSV");
}

OptionalCsv open_csv(const std::string& path, const std::vector<std::string>& columns) {
  return path.empty() ? OptionalCsv() : OptionalCsv(std::in_place, path, columns);
}

tmcmc::Problem interruptible(tmcmc::Problem problem) {
  problem.log_likelihood = [log_likelihood = std::move(problem.log_likelihood)](
                               const Eigen::Ref<const Eigen::MatrixXd>& points,
                               Eigen::Ref<Eigen::VectorXd> values) {
    io::stop_if_interrupted();
    log_likelihood(points, values);
  };
  problem.look = io::stop_if_interrupted;
  return problem;
}

std::string digits(double value, int significant) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value, significant) : "nan";
}

std::string or_undefined(fmt::format_string<const double&> format, const double value) {
  return std::isnan(value) ? "undefined" : fmt::format(format, value);
}

}  // namespace command_line
