#include "command_line.hpp"

#include <omp.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "io/partial_files.hpp"

namespace experiments {

namespace {

const std::vector<std::string> deviation_names = {"population", "sample"};
const std::vector<std::string> counted_names = {"all", "feasible"};
const std::vector<std::string> move_names = {"resample-move", "growing-chains"};
const std::vector<std::string> centre_names = {"weighted-mean", "plain-mean"};
const std::vector<std::string> boundary_names = {"reject", "redraw"};
const std::vector<std::string> limit_names = {"grid", "supremum"};
const std::vector<std::string> phase_names = {"discrete-bin", "fourier-coefficient"};

/// A choice among names that stand in the order of an enum; the value is checked when it is parsed.
void add_choice(CLI::App& app, const std::string& option, std::optional<std::string>& value,
                const std::vector<std::string>& names, const std::string& description) {
  app.add_option(option, value, description)
      ->group("Reading, option by option")
      ->type_name(CLI::detail::join(names, "|"))
      ->check([names, option](const std::string& text) {
        for (const auto& name : names) {
          if (text == name) {
            return std::string();
          }
        }
        return fmt::format("{}: value '{}': expected {}", option, io::printable(text),
                           CLI::detail::join(names, " or "));
      });
}

template <class Enum>
void choose(const std::optional<std::string>& value, const std::vector<std::string>& names, Enum& target) {
  for (std::size_t i = 0; value && i < names.size(); ++i) {
    if (names[i] == *value) {
      target = static_cast<Enum>(i);
    }
  }
}

/// Number checks with a message of the one form that all errors have.
CLI::Validator number(const std::string& option, const std::function<bool(double)>& accept,
                      const std::string& expected) {
  return CLI::Validator(
      [option, accept, expected](const std::string& text) {
        double value = 0.0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || end != text.data() + text.size() || !accept(value)) {
          return fmt::format("{}: value '{}': expected {}", option, io::printable(text), expected);
        }
        return std::string();
      },
      "", option);
}

CLI::Validator positive(const std::string& option) {
  return number(
      option, [](double x) { return x > 0.0 && std::isfinite(x); }, "a positive number");
}

CLI::Validator count(const std::string& option) {
  return number(
      option, [](double x) { return x >= 1.0 && x <= 1e9 && x == std::floor(x); },
      "a whole number, at least 1");
}

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

}  // namespace

Program::Program(const std::string& name, const std::string& purpose) : app_(purpose, name) {
  app_.set_version_flag("--version", fmt::format("{} {}", name, COMPANION_VERSION));
  app_.get_formatter()->column_width(36);
  app_.option_defaults()->always_capture_default();
  app_.add_flag("--quiet", quiet_, "Print no report and show no progress");
}

void Program::add_output(const std::string& description) {
  app_.add_option("--output", output_,
                  description + "; '-' is standard output. Without it no file is written")
      ->type_name("FILE");
}

void Program::add_file_output(const std::string& option, std::string& path, const std::string& description) {
  app_.add_option(option, path, description)->type_name("FILE");
}

int Program::run(int argc, char** argv, const std::function<void()>& body) {
  const auto fail = [&](int status, const std::string& message) {
    fmt::print(stderr, "{}: error: {}\n", app_.get_name(), message);
    return status;
  };
  io::remove_partial_files_on_signals();
  try {
    app_.parse(argc, argv);
    body();
  } catch (const CLI::Success& request) {  // --help, --version
    app_.exit(request);
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
  } catch (const std::exception& error) {
    return fail(1, error.what());
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
      ->check(number(
          "--infeasible-log-likelihood", [](double x) { return x < 0.0; }, "a negative number or -inf"));
}

void PhysicsOptions::add_driving_force_to(CLI::App& app) {
  app.add_option("--driving-force", driving_force_n, "k Y_b, N")
      ->type_name("NEWTON")
      ->check(positive("--driving-force"));
}

study::Reading PhysicsOptions::reading() const {
  study::Reading r = study::reading(study::parse_reading(reading_name));
  choose(limit, limit_names, r.physics.limit);
  choose(phase, phase_names, r.physics.phase);
  r.infeasible_log_likelihood = infeasible_log_likelihood.value_or(r.infeasible_log_likelihood);
  r.physics.driving_force_n = driving_force_n;
  return r;
}

void SamplerOptions::add_to(CLI::App& app) {
  const std::string group = "Reading, option by option";
  add_choice(app, "--deviation", deviation, deviation_names,
             "Standard deviation in the CoV (Eq. 6): N or N-1");
  add_choice(app, "--counted", counted, counted_names, "Samples that the criterion counts");
  add_choice(app, "--move", move, move_names, "How a stage moves its samples");
  add_choice(app, "--centre", centre, centre_names, "Mean in the proposal covariance (Eq. 5)");
  add_choice(app, "--boundary", boundary, boundary_names, "Proposals outside the prior box");
  app.add_option("--move-steps", move_steps, "Metropolis steps a chain and stage (resample-move)")
      ->group(group)
      ->check(count("--move-steps"));
  app.add_option("--proposal-scale", proposal_scale, "gamma of Eq. 5")
      ->group(group)
      ->check(positive("--proposal-scale"));
  app.add_option("--cov-target", cov_target, "Criterion of TMCMC (Eq. 6)")
      ->group(group)
      ->check(positive("--cov-target"));
  app.add_option("--ess-fraction", ess_fraction, "Criterion of TMCMC-II as a fraction of N (Eq. 9)")
      ->group(group)
      ->check(number(
          "--ess-fraction", [](double x) { return x > 0.0 && x <= 1.0; }, "a number in (0, 1]"));
  app.add_option("--max-stages", max_stages, "Most stages a run may take")
      ->group(group)
      ->check(count("--max-stages"));
  app.add_option("--minimum-step", minimum_step, "Smallest step of beta")
      ->group(group)
      ->check(number(
          "--minimum-step", [](double x) { return x >= 0.0 && x < 1.0; }, "a number in [0, 1)"));
  app.add_option("--samples", samples, "N, samples a run")
      ->check(number(
          "--samples", [](double x) { return x >= 2.0 && x <= 1e9 && x == std::floor(x); },
          "a whole number, at least 2"));
}

void SamplerOptions::apply(study::Reading& reading) const {
  tmcmc::Options& o = reading.sampler;
  choose(deviation, deviation_names, o.criterion.deviation);
  choose(counted, counted_names, o.criterion.counted);
  choose(move, move_names, o.move);
  choose(centre, centre_names, o.centre);
  choose(boundary, boundary_names, o.boundary);
  o.move_steps = move_steps.value_or(o.move_steps);
  o.proposal_scale = proposal_scale.value_or(o.proposal_scale);
  o.max_stages = max_stages.value_or(o.max_stages);
  o.minimum_step = minimum_step.value_or(o.minimum_step);
  o.samples = samples;
}

void RunOptions::add_seed_to(CLI::App& app) {
  app.add_option("--seed", seed, "Seed of the random streams")->check([](const std::string& text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size()
               ? std::string()
               : fmt::format("--seed: value '{}': expected a whole number from 0 to 2^64 - 1",
                             io::printable(text));
  });
}

void RunOptions::add_to(CLI::App& app) {
  app.add_option("--runs", runs, "Runs of each sampler")->check(count("--runs"));
  add_seed_to(app);
  add_threads_to(app);
}

void RunOptions::add_threads_to(CLI::App& app) {
  app.add_option("--threads", threads, "Threads; 0: as many as the machine has. Results do not depend on it")
      ->check(number(
          "--threads", [](double x) { return x >= 0.0 && x <= 4096.0 && x == std::floor(x); },
          "a whole number from 0 to 4096"));
}

study::StudyOptions RunOptions::study_options() const {
  study::StudyOptions options;
  options.runs = runs;
  options.seed = seed;
  options.threads = threads == 0 ? omp_get_max_threads() : threads;
  return options;
}

}  // namespace experiments
