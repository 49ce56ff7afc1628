#include "command_line.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>
#include <string_view>

#include "io/interrupt.hpp"

namespace experiments {

namespace {

constexpr std::size_t longest_message = 8192;  // more than the longest path

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

/// A file that is opened later must not get the number of a standard stream that the caller has closed: what is printed
/// would go into it. Writing to standard output and error fails as before.
void keep_standard_descriptors() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) < 0) {
      ::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    }
  }
}

/// CLI11 would take the next word for the value.
void refuse_empty_values(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view word(argv[i]);
    if (word.starts_with("--") && word.ends_with('=')) {
      throw std::invalid_argument(
          fmt::format("{}: value '': expected a value (see --help)", word.substr(0, word.size() - 1)));
    }
  }
}

/// Refuses what the check refuses, as "--option: value '...': expected ...".
CLI::Validator validator(const std::string& option, const Check& check) {
  return CLI::Validator(
      [option, check](std::string& word) {
        return check.accept(word)
                   ? std::string()
                   : fmt::format("{}: value '{}': expected {}", option, io::printable(word), check.expected);
      },
      "", option);
}

template <class Value>
void add_choice_to(CLI::App& app, const std::string& option, Value& value,
                   const std::vector<std::string>& names, const std::string& description,
                   const std::string& group) {
  app.add_option(option, value, description)
      ->group(group)
      ->type_name(CLI::detail::join(names, "|"))
      ->transform(validator(option, one_of(names)));
}

std::string value_of(const CLI::Option& option) {
  return option.count() > 0 ? option.results().back() : option.get_default_str();
}

}  // namespace

Program::Program(const std::string& name, const std::string& purpose)
    : app_(std::make_unique<CLI::App>(purpose, name)) {
  app_->set_version_flag("--version", fmt::format("{} {}", name, COMPANION_VERSION));
  app_->get_formatter()->column_width(36);
  app_->option_defaults()->always_capture_default();
  app_->add_flag("--quiet", quiet_, "Print no report and show no progress");
  app_->add_flag("--show-options", show_options_, "Print every option with its value, defaults too, and end")
      ->configurable(false);
}

Program::~Program() = default;

template <class Number>
void Program::add_number(const std::string& option, Number& value, const Check& check,
                         const std::string& description, const std::string& group) {
  app_->add_option(option, value, description)->group(group)->transform(validator(option, check));
}

template void Program::add_number(const std::string&, double&, const Check&, const std::string&,
                                  const std::string&);
template void Program::add_number(const std::string&, long&, const Check&, const std::string&,
                                  const std::string&);
template void Program::add_number(const std::string&, int&, const Check&, const std::string&,
                                  const std::string&);
template void Program::add_number(const std::string&, std::uint64_t&, const Check&, const std::string&,
                                  const std::string&);
template void Program::add_number(const std::string&, std::optional<double>&, const Check&,
                                  const std::string&, const std::string&);
template void Program::add_number(const std::string&, std::optional<long>&, const Check&, const std::string&,
                                  const std::string&);

void Program::add_text(const std::string& option, std::string& value, const std::string& type,
                       const std::string& description) {
  app_->add_option(option, value, description)->type_name(type);
}

void Program::add_choice(const std::string& option, std::string& value, const std::vector<std::string>& names,
                         const std::string& description, const std::string& group) {
  add_choice_to(*app_, option, value, names, description, group);
}

void Program::add_choice(const std::string& option, std::optional<std::string>& value,
                         const std::vector<std::string>& names, const std::string& description,
                         const std::string& group) {
  add_choice_to(*app_, option, value, names, description, group);
}

void Program::add_checked_text(const std::string& option, std::optional<std::string>& value,
                               const std::string& type, const Check& check, const std::string& description,
                               const std::string& group) {
  app_->add_option(option, value, description)
      ->group(group)
      ->type_name(type)
      ->transform(validator(option, check));
}

void Program::add_flag(const std::string& option, bool& value, const std::string& description,
                       const std::string& group) {
  app_->add_flag(option, value, description)->group(group);
}

void Program::add_input(const std::string& option, std::string& path, const std::string& description) {
  add_text(option, path, "CSV", description);
}

void Program::add_required_input(const std::string& option, std::string& path,
                                 const std::string& description) {
  app_->add_option(option, path, description)->type_name("CSV")->required();
}

void Program::add_output(const std::string& description) {
  add_file_output("--output", output_,
                  description + "; '-' is standard output. Without it no file is written");
}

void Program::add_output(const std::string& description, const std::string& path) {
  output_ = path;
  add_file_output("--output", output_, description);
}

void Program::add_file_output(const std::string& option, std::string& path, const std::string& description) {
  add_text(option, path, "FILE", description);
}

void Program::add_read_file(const std::string& path) {
  read_files_.push_back(path);
  if (is_parsed_) {
    check_paths();
  }
}

void Program::print(std::string text) const {
  const auto is_control = [](char c) { return (c >= 0 && c < ' ' && c != '\n') || c == 0x7f; };
  std::replace_if(text.begin(), text.end(), is_control, '?');
  std::fwrite(text.data(), 1, text.size(), writes_to_stdout_ ? stderr : stdout);
}

/// No value is empty, and no file is written that is read, or written by another option.
void Program::check_paths() {
  is_parsed_ = true;
  std::vector<std::pair<const CLI::Option*, std::string>> files;
  for (const CLI::Option* option : app_->get_options()) {
    const bool has_value = option->get_items_expected_max() > 0;
    if (has_value && option->count() > 0 && option->results().back().empty()) {
      throw std::invalid_argument(
          fmt::format("{}: value '': expected a value (see --help)", option->get_name()));
    }
    const std::string type = option->get_type_name();
    if ((type == "FILE" || type == "CSV" || type == "PROGRAM") && !value_of(*option).empty()) {
      files.emplace_back(option, value_of(*option));
      writes_to_stdout_ = writes_to_stdout_ || (type == "FILE" && value_of(*option) == "-");
    }
  }
  for (const std::string& path : read_files_) {
    files.emplace_back(nullptr, path);
  }
  for (const auto& [written, path] : files) {
    for (const auto& [other, other_path] : files) {
      if (written != nullptr && written != other && written->get_type_name() == "FILE" &&
          io::is_same_output(path, other_path)) {
        throw std::invalid_argument(fmt::format(
            "{}: value '{}': expected another file than {}", written->get_name(), io::printable(path, 200),
            other == nullptr ? "one that is read" : "that of " + other->get_name()));
      }
    }
  }
}

int Program::run(int argc, char** argv, const std::function<void()>& body) {
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
  if (!is_silent_ && io::interrupt_signal() != SIGPIPE) {  // whoever closed the pipe knows
    std::fputs(fmt::format("{}: interrupted: {}\n", app_->get_name(), interrupted.kept).c_str(), stderr);
  }
  io::die_of_interrupt();
}

int Program::run_to_end(int argc, char** argv, const std::function<void()>& body) {
  const auto fail = [&](int status, const std::string& message) {
    if (io::interrupt_signal() != 0) {  // a system call that was broken off
      return status;
    }
    if (!is_silent_) {
      const std::string line =
          fmt::format("{}: error: {}\n", app_->get_name(), io::printable(message, longest_message));
      std::fwrite(line.data(), 1, line.size(), stderr);
    }
    return status;
  };
  try {
    refuse_empty_values(argc, argv);
    app_->parse(argc, argv);
    check_paths();
    if (show_options_) {
      fmt::print("{}", is_silent_ ? "" : app_->config_to_str(true));
    } else {
      body();
    }
  } catch (const CLI::Success& request) {  // --help, --version
    if (!is_silent_) {
      app_->exit(request);
    }
  } catch (const CLI::ParseError& error) {
    std::string message = first_line(error.what());
    const auto named = message.find(": --");  // CLI11 puts the option in front of a check's own message
    if (named != std::string::npos && message.rfind("--", 0) == 0) {
      message.erase(0, named + 2);
    }
    return fail(2, message + " (see --help)");
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

tmcmc::LogLikelihood interruptible(tmcmc::LogLikelihood log_likelihood) {
  return [log_likelihood = std::move(log_likelihood)](const Eigen::Ref<const Eigen::MatrixXd>& points,
                                                      Eigen::Ref<Eigen::VectorXd> values) {
    io::stop_if_interrupted();
    log_likelihood(points, values);
  };
}

tmcmc::Problem interruptible(tmcmc::Problem problem) {
  problem.log_likelihood = interruptible(std::move(problem.log_likelihood));
  return problem;
}

std::optional<io::CsvWriter> open_csv(const std::string& path, const std::vector<std::string>& columns) {
  if (path.empty()) {
    return std::nullopt;
  }
  return std::optional<io::CsvWriter>(std::in_place, path, columns);
}

std::string digits(double value, int significant) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value, significant) : "nan";
}

std::string or_undefined(fmt::format_string<const double&> format, const double value) {
  return std::isnan(value) ? "undefined" : fmt::format(format, value);
}

}  // namespace experiments
