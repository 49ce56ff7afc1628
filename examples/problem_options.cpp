#include "problem_options.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <type_traits>

#include "command_line/build_info.hpp"
#include "errors/invalid_value.hpp"
#include "own_models.hpp"

namespace examples {

namespace {

using command_line::count;
using command_line::option_of;

constexpr long default_chains = 100;
/// Options of the sampler that have keys of their own.
const std::vector<std::string> no_sampler_options = {"evaluation_budget", "threads", "batch_rows",
                                                     "diagnose"};

CLI::Validator any_text() {
  return command_line::normalising([](const std::string& word) { return std::optional(word); }, "");
}

}  // namespace

template <class T>
ProblemOptions::Key& ProblemOptions::add(CLI::App& app, const char* table, const char* name,
                                         const char* option, T& target, const std::string& type,
                                         const CLI::Validator& check, const std::string& help) {
  constexpr bool is_number =
      !std::is_same_v<T, std::string> && !std::is_same_v<T, std::optional<std::string>>;
  CLI::Option* const added = app.add_option(option, target, help)
                                 ->transform(check)
                                 ->group(fmt::format("{} (table [{}] of the problem file)", table, table));
  if (!type.empty()) {
    added->type_name(type);
  }
  const auto set = [&target](const std::string& text) {
    if constexpr (is_number) {
      std::conditional_t<std::is_same_v<T, std::optional<long>>, long, T> value{};
      std::from_chars(text.data(), text.data() + text.size(), value);
      target = value;
    } else {
      target = text;
    }
  };
  return keys_.emplace_back(Key{table, name, added, check, is_number, set});
}

ProblemOptions::ProblemOptions(CLI::App& app) {
  app.add_option("problem", path_, "Problem file in TOML; what the command line says too is taken from there")
      ->type_name("TOML");
  observations = command_line::data_file("examples", "frame_observations.csv");
  prior.marginals = command_line::data_file("examples", "frame_prior.csv");
  add_model(app);
  add_data_and_prior(app);
  add_run_and_outputs(app);
  add_sampler(app);
  app.callback([this] { read(); });
}

void ProblemOptions::add_model(CLI::App& app) {
  const CLI::Validator text = any_text();
  add(app, "model", "built_in", "--built-in", built_in, CLI::detail::join(built_in_names(), "|"),
      command_line::one_of(built_in_names()), "Model in C++");
  add(app, "model", "driving_force", "--driving-force", driving_force_n, "", command_line::positive(),
      "k Y_b of the model friction, N");
  add(app, "model", "command", "--command", command, "PROGRAM", text,
      "Program that computes a batch: PROGRAM points.csv log_likelihoods.csv");
  add(app, "model", "worker", "--worker", worker, "PROGRAM", text,
      "Program that keeps running: n and n points as lines in, n log-likelihoods as lines out");
  add(app, "model", "um_bridge", "--um-bridge", um_bridge, "URL", text,
      "Server of the UM-Bridge protocol, with --model");
  add(app, "model", "name", "--model", model, "NAME", text, "Model of the UM-Bridge server");
  add(app, "model", "config", "--config", config, "JSON", text,
      "Object that is passed to it; in the problem file a table");
  add(app, "model", "timeout", "--timeout", timeout_seconds, "",
      command_line::number([](double x) { return x >= 0.0 && std::isfinite(x); }, "a number of at least 0"),
      "Most seconds of one call of the program; 0: no limit");
  add(app, "model", "parallel", "--parallel", parallel, "", count(1, 4096),
      "Calls of the program at a time; without it as many as --threads");
  add(app, "model", "batch", "--batch", batch, "", count(0),
      "Most points of a call of the program; 0: all that there are for each call at a time");
}

void ProblemOptions::add_data_and_prior(CLI::App& app) {
  const CLI::Validator text = any_text();
  add(app, "data", "file", "--observations", observations, "CSV", text,
      "Measurements: for shear_frame the columns mode (1 or 2), frequency_hz; for friction those of Table 1; "
      "for another "
      "program those that its outputs are compared with, or a file that it reads");
  add(app, "data", "observation", "--observation", observation, "COLUMN", text,
      "The model has outputs, which are compared with this column of --observations by a Gaussian "
      "likelihood. Without "
      "it the output is the log-likelihood (with --um-bridge and --observations: the column observation)");
  add(app, "data", "standard_deviation", "--standard-deviation", standard_deviation, "COLUMN|FLOAT", text,
      "Its standard deviations: a column, or a number for all; without it the column standard_deviation");
  add(app, "data", "noise", "--noise", noise, "PARAMETER", text,
      "Parameter by which they are multiplied, and which the model does not see");
  add(app, "prior", "file", "--prior", prior.marginals, "CSV", text,
      "CSV with columns parameter, lower, upper (uniform), or parameter, distribution and a column for each "
      "argument. With another program: the parameters, of any names");
  add(app, "prior", "correlation", "--prior-correlation", prior.correlations, "CSV", text,
      "Matrix of correlations: CSV with a first column parameter (correlations of the parameters) or "
      "normal_score, and a column for each parameter; without it they are independent");
}

void ProblemOptions::add_run_and_outputs(CLI::App& app) {
  const CLI::Validator text = any_text();
  add(app, "run", "evaluations", "--evaluations", evaluations, "", count(500),
      "Budget of log-likelihoods of a run");
  add(app, "run", "runs", "--runs", runs, "", count(1, 1000),
      "Independent runs, which differ in their random numbers");
  add(app, "run", "seed", "--seed", seed, "", command_line::seed(), "Seed of the random streams");
  add(app, "run", "threads", "--threads", threads, "", count(0, 4096),
      "Threads; 0: as many as the machine has. Results do not depend on it");
  add(app, "output", "samples", "--output", output, "FILE", text,
      "CSV: a row per sample, with its log-likelihood; '-' is standard output. Without it no file is "
      "written");
  add(app, "output", "netcdf", "--netcdf", netcdf, "FILE", text,
      "Samples, stages and observations in the layout of ArviZ");
  add(app, "output", "summary", "--summary", summary, "FILE", text,
      "CSV: a row per parameter with mean, sd, quantiles, effective sample size and R-hat");
  add(app, "output", "figures", "--figures", figures, "DIRECTORY", text,
      "Directory for a corner plot, marginals, the stages, and of a model with outputs the measurements in "
      "their "
      "posterior predictive bands, drawn by gnuplot, with their tables");
  add(app, "output", "predictive_draws", "--predictive-draws", predictive_draws, "", count(0, 100000),
      "Draws of the posterior at which --figures evaluates a model with outputs again for these bands, "
      "beyond "
      "--evaluations; 0: without them");
  add(app, "output", "checkpoint", "--checkpoint", checkpoint, "FILE", text,
      "Progress after each stage; the same command goes on from it. Without it: the name of --output with "
      ".checkpoint, if --output is a file");
}

void ProblemOptions::add_sampler(CLI::App& app) {
  for (const tmcmc::OptionText& row : tmcmc::option_table()) {
    const std::string name(row.name), option = option_of(row.name);
    if (std::find(no_sampler_options.begin(), no_sampler_options.end(), name) == no_sampler_options.end()) {
      Key& key = add(app, "sampler", name.c_str(), option.c_str(), sampler_[name], command_line::type_of(row),
                     command_line::check_of(row), std::string(row.help));
      key.is_number = row.values.empty();
    }
  }
}

const ProblemOptions::Key& ProblemOptions::key_of(const std::string& option) const {
  return *std::find_if(keys_.begin(), keys_.end(),
                       [&](const Key& key) { return key.option->get_name() == option; });
}

std::string ProblemOptions::place_of(const Key& key) const {
  return key.line == 0
             ? key.option->get_name()
             : fmt::format("{}:{}: {}.{}", io::printable_path(path_), key.line, key.table, key.name);
}

bool ProblemOptions::is_given(const std::string& option) const {
  const Key& key = key_of(option);
  return key.line > 0 || key.option->count() > 0;
}

bool ProblemOptions::is_other_program() const {
  return !command.empty() || !worker.empty() || !um_bridge.empty();
}

int ProblemOptions::thread_count() const {
  return threads == 0 ? omp_get_max_threads() : threads;
}

void ProblemOptions::refuse(const std::string& option, const std::string& expected) const {
  const Key& key = key_of(option);
  const std::string text = key.option->count() > 0 ? key.option->results().back() : key.text;
  throw io::InputError(
      fmt::format("{}: value '{}': expected {}", place_of(key), io::printable(text, 200), expected));
}

tmcmc::Options ProblemOptions::sampler() const {
  const auto place = [this](std::string_view name) {
    return name == "evaluation_budget" ? place_of(key_of("--evaluations"))
                                       : place_of(key_of(option_of(name)));
  };
  const auto given = [this](std::string_view name) {
    const auto found = sampler_.find(name);
    return found == sampler_.end() ? std::nullopt : found->second;
  };
  const bool is_chosen = std::any_of(sampler_.begin(), sampler_.end(),
                                     [](const auto& option) { return option.second.has_value(); });
  tmcmc::Options options;
  try {
    const auto chains = given("chains");
    const long number = chains ? std::stol(*chains) : default_chains;
    options = is_chosen ? tmcmc::recommended_moves(evaluations, number)
                        : tmcmc::recommended_options(evaluations, number);
  } catch (const errors::InvalidValue& error) {
    const std::string name = error.field().substr(error.field().find('.') + 1);
    throw errors::InvalidValue(fmt::format("{}: value '{}'", place(name), error.value()), "",
                               error.expected());
  }
  command_line::set_sampler_options(options, given, place);
  options.threads = thread_count();
  return options;
}

}  // namespace examples
