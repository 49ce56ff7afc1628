/// \file
/// The options of own_model, from a problem file and the command line.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "command_line/checks.hpp"
#include "command_line/sampler_options.hpp"
#include "problem/node.hpp"
#include "problem/prior_file.hpp"
#include "tmcmc/options.hpp"

namespace examples {

/// The options of the problem. Each value, except the tables of parameters and correlations, is
/// both a key in one of the tables of the file and an option of the command line, which takes
/// precedence. Paths in the file are relative to the file.
class ProblemOptions {
 public:
  /// Adds the options, and the file as the positional argument.
  explicit ProblemOptions(CLI::App& app);

  /// Model in C++ by its name; the default if no other is given.
  std::string built_in = "shear_frame";
  /// Program that is called for each batch; empty: none.
  std::string command;
  /// Program that keeps running; empty: none.
  std::string worker;
  /// Address of a UM-Bridge server; empty: none.
  std::string um_bridge;
  /// Name of the model on that server.
  std::string model;
  /// JSON object that is passed to that model.
  std::string config = "{}";
  /// k Y_b of the friction rig, N.
  double driving_force_n = 2.5;
  /// Time limit of a call; 0: none.
  double timeout_seconds = 0.0;
  /// Largest number of concurrent calls; default: as many as threads.
  std::optional<long> parallel;
  /// Largest number of points per call; 0: equal shares.
  long batch = 0;

  /// CSV of the data.
  std::string observations;
  /// Column of that file with which model outputs are compared.
  std::string observation;
  /// Column of the standard deviations, or one number for all.
  std::string standard_deviation;
  /// The parameter that multiplies the standard deviations; empty: none.
  std::string noise;
  /// Numbers of the problem file in the place of the column.
  std::vector<double> observed;
  /// Numbers of the problem file in the place of standard_deviation.
  std::vector<double> observed_sd;
  /// Files in the place of the table of parameters.
  problem::PriorFiles prior;

  /// Evaluations of a run.
  long evaluations = 31000;
  /// Number of independent runs.
  long runs = 1;
  /// Seed of all runs.
  std::uint64_t seed = 1;
  /// Number of threads; 0: as many as the machine has.
  int threads = 0;

  /// CSV of the samples.
  std::string output;
  /// NetCDF file of samples, stages and observations.
  std::string netcdf;
  /// Directory of figures and their tables.
  std::string figures;
  /// Draws of the posterior at which the model is evaluated for the figures; 0: none.
  long predictive_draws = 500;
  /// CSV of the table that is printed.
  std::string summary;
  /// File of the kept stages.
  std::string checkpoint;

  /// The problem file; nothing if none is given.
  [[nodiscard]] const std::optional<problem::File>& file() const { return file_; }
  /// Whether the value of an option, such as --prior, was given in the file or on the command line.
  [[nodiscard]] bool is_given(const std::string& option) const;
  /// Whether the model is another program.
  [[nodiscard]] bool is_other_program() const;
  /// The recommended options, with enough chains that a batch justifies the start of a program; if
  /// an option of the sampler was given, the recommended moves with that option.
  /// \throws errors::InvalidValue naming the option or the place in the file.
  [[nodiscard]] tmcmc::Options sampler() const;
  /// The number of threads, with 0 resolved.
  [[nodiscard]] int thread_count() const;
  /// Refuses a value of the problem file or the command line, such as
  /// "problem.toml:3: data.noise: value 'x': expected ...".
  [[noreturn]] void refuse(const std::string& option, const std::string& expected) const;

 private:
  /// A value, in the file and on the command line.
  struct Key {
    std::string table, name;  // run, evaluations
    CLI::Option* option;
    CLI::Validator check;
    bool is_number;
    std::function<void(const std::string&)> set;
    std::size_t line = 0;  // of the file; 0: not from there
    std::string text = {};
  };
  template <class T>
  Key& add(CLI::App& app, const char* table, const char* name, const char* option, T& target,
           const std::string& type, const CLI::Validator& check, const std::string& help);
  void add_model(CLI::App& app);
  void add_data_and_prior(CLI::App& app);
  void add_run_and_outputs(CLI::App& app);
  void add_sampler(CLI::App& app);
  void read();
  void take(const std::string& table, const std::string& name, const problem::Node& node);
  bool take_numbers(const std::string& table, const std::string& name, const problem::Node& node);
  [[nodiscard]] const Key& key_of(const std::string& option) const;
  [[nodiscard]] std::string place_of(const Key& key) const;

  std::string path_;
  std::optional<problem::File> file_;
  std::vector<Key> keys_;
  std::map<std::string, std::optional<std::string>, std::less<>> sampler_;
};

}  // namespace examples
