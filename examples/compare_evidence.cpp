// Compares models of the same data by their evidence: log-evidences with their errors, Bayes
// factors against the best model, and posterior probabilities of the models (Kass and Raftery
// 1995), from the files that own_model --netcdf writes.

#include "command_line/report.hpp"
#include "storage/compare.hpp"

using namespace command_line;

int main(int argc, char** argv) {
  CLI::App app("Compares models of the same data by their evidence.", "compare_evidence");
  Report report(app);
  std::vector<std::string> files;
  std::vector<double> priors;
  bool is_same_data = false;
  std::string output;
  app.add_option("runs", files, "A file for each model, as own_model --netcdf writes it")
      ->type_name("NETCDF")
      ->required()
      ->expected(2, 1000);
  app.add_option(
         "--prior", priors,
         "Prior probability of each model, in any scale, with commas between them; without it equal ones")
      ->type_name("P,P,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_flag(
      "--same-data", is_same_data,
      "The data are the same, although the files do not say so (models that keep their data to themselves)");
  add_output(app, output, "CSV: a row per model");

  return report.run(argc, argv, [&] {
    if (!priors.empty() && priors.size() != files.size()) {
      throw std::invalid_argument(
          fmt::format("--prior: {} values: expected {}, one for each file", priors.size(), files.size()));
    }
    std::vector<storage::StoredEvidence> runs;
    std::vector<tmcmc::Evidence> evidences;
    for (const auto& file : files) {
      runs.push_back(storage::read_evidence(file));
      evidences.push_back(runs.back().evidence);
    }
    if (!is_same_data) {
      storage::require_same_data(runs);
    }
    const auto models = storage::compare(evidences, priors);
    auto csv = open_csv(output, {"model", "log_evidence", "log_evidence_error", "log_bayes_factor",
                                 "log_bayes_factor_error", "probability", "probability_error"});
    report("{:<28} {:>22} {:>26} {:>24}\n", "", "log-evidence", "log Bayes factor to best", "probability");
    for (std::size_t i = 0; i < models.size(); ++i) {
      const auto& m = models[i];
      const auto with_error = [](double value, double error) {
        return fmt::format("{:.3f} +- {:.3f}", value, error);
      };
      report("{:<28} {:>22} {:>26} {:>24}\n", runs[i].path, with_error(m.log_evidence, m.log_evidence_error),
             with_error(m.log_bayes_factor, m.log_bayes_factor_error),
             fmt::format("{:.4g} +- {:.2g}", m.probability, m.probability_error));
      csv.row(runs[i].path, m.log_evidence, m.log_evidence_error, digits(m.log_bayes_factor),
              digits(m.log_bayes_factor_error), digits(m.probability), digits(m.probability_error));
    }
    io::commit_all(csv);
  });
}
