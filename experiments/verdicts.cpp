// A verdict on every printed number and claim of the paper, with its evidence. Each number of Tables 3 and 4 gets its
// place in the distribution that replicated studies give it; each claim a statistic. That a number is reproduced and that
// a claim is supported are two things, and stand in two columns.
//
// Data: Tables 3 and 4 and the claims as printed; replicated_study.csv; the exact posterior for C1 and Table 1 for C7.

#include <algorithm>
#include <boost/algorithm/string/replace.hpp>
#include <boost/math/distributions/chi_squared.hpp>

#include "inputs.hpp"
#include "replication/audit.hpp"

using namespace experiments;
using replication::Verdict;

namespace {

const replication::Truth stated;             // Section 3 of the paper
constexpr double alternative_force_n = 1.0;  // a test beside that of the stated force, not reported here

struct Judged {
  std::string number;  // is the printed number one that comes out again?
  Verdict claim;
  std::string evidence;
};

void write_contrast(io::CsvWriter& csv, const char* quantity, const char* statistic,
                    const replication::ContrastVerdict& c) {
  csv.row(quantity, statistic, c.printed, c.interval.low, c.interval.high, c.p.value, c.p.standard_error,
          c.replicated.ratio, c.replicated.interval.low, c.replicated.interval.high, c.replicated.margin);
}

Judged judge_contrast(const replication::ContrastVerdict& c, const char* what) {
  return {replication::name_of(replication::judge_number(c.p)),
          replication::judge_contrast(c.p, c.replicated),
          fmt::format(
              "printed {} {:.3g}, null 95 % {:.3g} to {:.3g}, p = {:.2g} (standard error {:.1g}); replicated "
              "ratio of medians {:.3f} ({:.3f} to {:.3f})",
              what, c.printed, c.interval.low, c.interval.high, c.p.value, c.p.standard_error,
              c.replicated.ratio, c.replicated.interval.low, c.replicated.interval.high)};
}

/// C1: the share of studies whose p-boxes hold both stated values, and how likely the posterior makes the stated force.
Judged judge_enclosure(const std::vector<replication::StudySummary>& studies, double exceedance) {
  double enclosing = 0.0;
  for (const auto& s : studies) {
    const bool force = s.smallest[0] <= stated.friction_force_n && s.largest[0] >= stated.friction_force_n;
    const bool frequency =
        s.smallest[1] <= stated.natural_frequency_hz && s.largest[1] >= stated.natural_frequency_hz;
    enclosing += force && frequency ? 1.0 : 0.0;
  }
  const double share = enclosing / static_cast<double>(studies.size());
  return {share >= 0.5 ? "reproduced" : "not reproduced",
          exceedance < 0.025 ? Verdict::not_supported : Verdict::reproduced,
          fmt::format("the ends of the p-boxes hold both stated values in {:.0f} % of the studies, but the "
                      "exact posterior "
                      "gives P(F_mu > {} N) = {:.2g}: the p-box reaches it in its tail alone",
                      100.0 * share, stated.friction_force_n, exceedance)};
}

/// C7: the likelihood-ratio test of the stated force, with the stated noise.
Judged judge_stated_force(const replication::Audit& audit, std::size_t observations) {
  const auto& fit = audit.friction_force;
  const auto& test = fit.tests.front();
  const double critical = quantile(boost::math::chi_squared(1.0), 1.0 - replication::significance_level);
  // NaN, where the motion would not be continuous, is no agreement either
  return {
      "not applicable", test.likelihood_ratio < critical ? Verdict::reproduced : Verdict::contradicted,
      fmt::format(
          "chi^2 of Table 1 is {:.1f} at {} N and {:.1f} at the least-squares estimate of {:.3f} N, on {} "
          "observations; likelihood ratio {:.1f}, 5 % bound {:.2f}, p = {:.1g}",
          test.chi_squared, test.value, fit.chi_squared, fit.estimate, observations, test.likelihood_ratio,
          critical, test.likelihood_ratio_p)};
}

std::string markdown_cell(const std::string& text) {
  return boost::algorithm::replace_all_copy(text, "|", "\\|");
}

/// C6: does the most frequent number of iterations in Table 4 agree with the text?
Judged judge_mode(const std::vector<replication::PrintedCounts>& printed) {
  std::string evidence = "Table 4: most runs take";
  bool eleven = true;
  for (const auto& column : printed) {
    const auto mode = std::max_element(column.counts.begin(), column.counts.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    evidence += fmt::format(" {} ({} of {})", mode->first, mode->second, column.sampler);
    eleven = eleven && mode->first == 11;
  }
  return {"not applicable", eleven ? Verdict::reproduced : Verdict::internally_contradictory, evidence};
}

}  // namespace

int main(int argc, char** argv) {
  Program program("verdicts", "A verdict on every printed number and claim, with its evidence.");
  InputFiles inputs;
  PhysicsOptions physics;
  TableOptions table_options;
  RunOptions run_options;
  std::string replicated = "data/generated/replicated_study.csv";
  std::string table3 = published("table3_pbox_area.csv");
  std::string table4 = published("table4_iteration_counts.csv");
  std::string claims = published("claims.csv");
  std::string markdown_output, contrasts_output;
  program.add_output("CSV: id, place, claim, number, verdict, evidence");
  program.add_file_output("--markdown-output", markdown_output, "The verdicts as a Markdown table");
  program.add_file_output(
      "--contrasts-output", contrasts_output,
      "CSV of the comparisons of the samplers behind C2 to C5: quantity, statistic, printed, null_low, "
      "null_high, p, ratio, ratio_low, ratio_high, margin");
  program.add_input("--replicated", replicated, "Studies written by replicated_study");
  program.add_input("--table3", table3, "Table 3 as printed");
  program.add_input("--table4", table4, "Table 4 as printed");
  program.add_input("--claims", claims, "Claims: CSV with columns id, place, claim");
  inputs.add_observations_to(program);
  inputs.add_prior_to(program);
  table_options.add_to(program);
  run_options.add_seed_to(program);
  physics.add_to(program);

  return program.run(argc, argv, [&] {
    const auto reading = physics.reading();
    const auto claim_table = io::CsvTable::read(claims);
    const auto ids = claim_table.text("id");
    const auto places = claim_table.text("place");
    const auto texts = claim_table.text("claim");
    const auto printed = read_printed_tables(table3, table4);
    const auto studies = read_studies(replicated, printed);
    const auto observations = read_observations(inputs.observations);
    const auto prior = prior_for(inputs, reading);
    require_once(claim_table, ids, "id", "each claim once");
    for (std::size_t i = 0; i < ids.size(); ++i) {
      if (ids[i].size() != 2 || ids[i][0] != 'C' || ids[i][1] < '1' || ids[i][1] > '9') {
        claim_table.fail(i, "id", "one of C1 to C9");
      }
    }
    for (char digit = '1'; digit <= '9'; ++digit) {
      const std::string id = {'C', digit};
      if (std::find(ids.begin(), ids.end(), id) == ids.end()) {
        throw io::InputError(
            fmt::format("{}: column 'id': no row '{}': expected one row for each of C1 to C9", claims, id));
      }
    }
    if (printed.counts.size() != 2 || printed.areas.size() != 4) {
      throw io::InputError(table4 + ": expected the columns of two samplers, and table 3 two rows");
    }
    auto csv = open_csv(program.output(), {"id", "place", "claim", "number", "verdict", "evidence"});
    auto contrasts =
        open_csv(contrasts_output, {"quantity", "statistic", "printed", "null_low", "null_high", "p",
                                    "p_standard_error", "ratio", "ratio_low", "ratio_high", "margin"});
    std::optional<io::OutputFile> markdown_file;
    if (!markdown_output.empty()) {
      markdown_file.emplace(markdown_output);
    }

    const std::string& first = printed.counts[0].sampler;
    const std::string& second = printed.counts[1].sampler;
    const auto area = [&](const std::string& sampler, std::size_t parameter) {
      const auto found = std::find_if(printed.areas.begin(), printed.areas.end(), [&](const auto& a) {
        return a.sampler == sampler && a.parameter == parameter;
      });
      return std::stod(found->printed);
    };
    const auto ratio = [&](std::size_t parameter) {
      return area(second, parameter) / area(first, parameter);
    };
    const auto force = replication::contrast_areas(studies, first, second, 0, ratio(0), run_options.seed);
    const auto frequency = replication::contrast_areas(studies, first, second, 1, ratio(1), run_options.seed);
    const auto iterations =
        replication::contrast_iterations(studies, printed.counts[0].counts, printed.counts[1].counts, first,
                                         second, run_options.seed, table_options.draws);
    const auto audit = replication::audit(observations, stated, alternative_force_n, reading.physics);

    const friction::Likelihood likelihood(observations, reading.physics);
    const auto exact = exact_posterior_for(inputs, likelihood, prior);
    const double exceedance = exact.marginal(friction::friction_force).exceedance(stated.friction_force_n);

    const auto judge = [&](const std::string& id) -> Judged {
      if (id == "C1") {
        return judge_enclosure(studies, exceedance);
      }
      if (id == "C2") {
        return judge_contrast(force, "ratio");
      }
      if (id == "C3") {
        return judge_contrast(frequency, "ratio");
      }
      if (id == "C4") {
        return judge_contrast(iterations, "deviance");
      }
      if (id == "C5") {  // a cause of worse mixing must make some quantity worse
        const bool one_algorithm = force.replicated.equivalent && frequency.replicated.equivalent &&
                                   iterations.replicated.equivalent;
        return {"not applicable", one_algorithm ? Verdict::contradicted : Verdict::not_supported,
                fmt::format(
                    "replicated medians, second sampler over first: F_mu area {:.3f}, omega_n area {:.3f}, "
                    "iterations {:.4f}; equivalent within {:.0f} %, {:.0f} % and {:.0f} %: {}",
                    force.replicated.ratio, frequency.replicated.ratio, iterations.replicated.ratio,
                    100.0 * replication::area_margin, 100.0 * replication::area_margin,
                    100.0 * replication::iteration_margin, one_algorithm ? "yes" : "no")};
      }
      if (id == "C6") {
        return judge_mode(printed.counts);
      }
      if (id == "C7") {
        return judge_stated_force(audit, observations.size());
      }
      if (id == "C8") {
        return {"not applicable", Verdict::contradicted,
                "N_eff = N / (1 + CoV^2): both rules are one equation (criterion_identity)"};
      }
      return {"not shown", Verdict::cannot_be_tested,
              "the paper shows neither; see Figure 5 and Table 5 here"};
    };

    std::string markdown = "| | claim | number | verdict on the claim | evidence |\n|---|---|---|---|---|\n";
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const Judged judged = judge(ids[i]);
      program.report("{}  {}\n    number: {}; claim: {}\n    {}\n", ids[i], texts[i], judged.number,
                     name_of(judged.claim), judged.evidence);
      markdown += fmt::format("| {} | {} | {} | **{}** | {} |\n", ids[i], markdown_cell(texts[i]),
                              judged.number, name_of(judged.claim), judged.evidence);
      if (csv) {
        csv->row(ids[i], places[i], texts[i], judged.number, name_of(judged.claim), judged.evidence);
      }
    }
    if (contrasts) {
      write_contrast(*contrasts, "friction_force_n", "ratio of areas", force);
      write_contrast(*contrasts, "natural_frequency_hz", "ratio of areas", frequency);
      write_contrast(*contrasts, "iterations", "two-sample deviance", iterations);
    }
    if (markdown_file) {
      markdown_file->write(markdown);
    }
    io::commit_all(csv, contrasts, markdown_file);
  });
}
