#include "command_line.hpp"

#include <fcntl.h>
#include <omp.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <new>
#include <string_view>

#include "io/signals.hpp"
#include "option_checks.hpp"

namespace experiments {

namespace {

const std::vector<std::string> limit_names = {"grid", "supremum"};
const std::vector<std::string> phase_names = {"discrete-bin", "fourier-coefficient"};

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

std::string value_of(const CLI::Option& option) {
  return option.count() > 0 ? option.results().back() : option.get_default_str();
}

}  // namespace

Program::Program(const std::string& name, const std::string& purpose) : app_(purpose, name) {
  app_.set_version_flag("--version", fmt::format("{} {}", name, COMPANION_VERSION));
  app_.get_formatter()->column_width(36);
  app_.option_defaults()->always_capture_default();
  app_.add_flag("--quiet", quiet_, "Print no report and show no progress");
  app_.add_flag("--show-options", show_options_, "Print every option with its value, defaults too, and end")
      ->configurable(false);
}

Program::Program(const std::string& name, const std::string& purpose, distributed::Ranks& ranks)
    : Program(name, purpose) {
  ranks_ = &ranks;
}

Program::~Program() = default;

CLI::Option* Program::add_input(const std::string& option, std::string& path,
                                const std::string& description) {
  return app_.add_option(option, path, description)->type_name("CSV");
}

void Program::add_output(const std::string& description) {
  app_.add_option("--output", output_,
                  description + "; '-' is standard output. Without it no file is written")
      ->type_name("FILE");
}

void Program::add_file_output(const std::string& option, std::string& path, const std::string& description) {
  app_.add_option(option, path, description)->type_name("FILE");
}

/// No value is empty, and no file is written that another option reads or writes.
void Program::check_paths() const {
  std::vector<const CLI::Option*> files;
  for (const CLI::Option* option : app_.get_options()) {
    const bool has_value = option->get_items_expected_max() > 0;
    if (has_value && option->count() > 0 && option->results().back().empty()) {
      throw std::invalid_argument(
          fmt::format("{}: value '': expected a value (see --help)", option->get_name()));
    }
    const bool is_file = option->get_type_name() == "FILE" || option->get_type_name() == "CSV";
    if (is_file && !value_of(*option).empty()) {
      files.push_back(option);
    }
  }
  for (const CLI::Option* written : files) {
    for (const CLI::Option* other : files) {
      if (written != other && written->get_type_name() == "FILE" &&
          io::is_same_output(value_of(*written), value_of(*other))) {
        throw std::invalid_argument(fmt::format("{}: value '{}': expected another file than that of {}",
                                                written->get_name(), io::printable(value_of(*written), 200),
                                                other->get_name()));
      }
    }
  }
}

int Program::run(int argc, char** argv, const std::function<void()>& body) {
  const auto fail = [&](int status, const std::string& message) {
    if (ranks_ == nullptr || ranks_->reports_failure()) {
      const std::string line =
          fmt::format("{}: error: {}\n", app_.get_name(), io::printable(message, longest_message));
      std::fwrite(line.data(), 1, line.size(), stderr);
    }
    return status;
  };
  keep_standard_descriptors();
  io::end_cleanly_on_signals(app_.get_name());
  try {
    refuse_empty_values(argc, argv);
    app_.parse(argc, argv);
    check_paths();
    if (show_options_) {
      fmt::print("{}", app_.config_to_str(true));
    } else {
      body();
    }
  } catch (const CLI::Success& request) {  // --help, --version
    if (leads()) {
      app_.exit(request);
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
  if (output_ == "-" && std::ferror(stderr) != 0) {
    return 2;
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    return fail(2, fmt::format("standard output: {}: expected to write the report", std::strerror(errno)));
  }
  return 0;
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

void PhysicsOptions::add_to(CLI::App& app) {
  app.add_option("--reading", reading_name,
                 "Set of options: how text, published scripts and mathematics are read")
      ->type_name(CLI::detail::join(study::reading_names(), "|"))
      ->check([](const std::string& text) {
        for (const auto& name : study::reading_names()) {
          if (text == name) {
            return std::string();
          }
        }
        return fmt::format("--reading: value '{}': expected as_published, as_worded or corrected",
                           io::printable(text));
      });
  add_driving_force_to(app);
  add_choice(app, "--limit", limit, limit_names, "S in the limit of continuous motion (Eq. 18)");
  add_choice(app, "--phase", phase, phase_names, "Phase angle (Eq. 21): bin of a transform, or exact");
  app.add_option("--infeasible-log-likelihood", infeasible_log_likelihood,
                 "Log-likelihood where the motion is not continuous: a number, or -inf")
      ->group("Reading, option by option")
      ->type_name("VALUE")
      ->transform(number(
          "--infeasible-log-likelihood", [](double x) { return x < 0.0; }, "a negative number or -inf"));
}

void PhysicsOptions::add_driving_force_to(CLI::App& app) {
  app.add_option("--driving-force", driving_force_n, "k Y_b, N")
      ->type_name("NEWTON")
      ->transform(positive("--driving-force"));
}

study::Reading PhysicsOptions::reading() const {
  study::Reading r = study::reading(study::parse_reading(reading_name));
  choose(limit, limit_names, r.physics.limit);
  choose(phase, phase_names, r.physics.phase);
  r.infeasible_log_likelihood = infeasible_log_likelihood.value_or(r.infeasible_log_likelihood);
  r.physics.driving_force_n = driving_force_n;
  return r;
}

void RunOptions::add_seed_to(CLI::App& app) {
  const auto whole = [](std::string& text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) {
      return fmt::format("--seed: value '{}': expected a whole number from 0 to 2^64 - 1", io::printable(text));
    }
    text = fmt::format("{}", value);
    return std::string();
  };
  app.add_option("--seed", seed, "Seed of the random streams")->transform(CLI::Validator(whole, "", "--seed"));
}

void RunOptions::add_to(CLI::App& app, long least_runs) {
  app.add_option("--runs", runs, "Runs of each sampler")->transform(count("--runs", least_runs));
  add_seed_to(app);
  add_threads_to(app);
}

void RunOptions::add_threads_to(CLI::App& app) {
  app.add_option("--threads", threads, "Threads; 0: as many as the machine has. Results do not depend on it")
      ->transform(count("--threads", 0, 4096));
}

study::StudyOptions RunOptions::study_options() const {
  study::StudyOptions options;
  options.runs = runs;
  options.seed = seed;
  options.threads = threads == 0 ? omp_get_max_threads() : threads;
  return options;
}

}  // namespace experiments
