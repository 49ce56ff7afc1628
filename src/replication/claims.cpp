#include "replication/claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <string>

#include "errors/invalid_value.hpp"

namespace replication {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr tmcmc::Index iterations_in_text = 11;  // of most runs, Section 4
const std::string not_applicable = "not applicable";

tmcmc::Index most_iterations(const PrintedColumn& column) {
  tmcmc::Index most = 0;
  for (const auto& [iterations, count] : column.counts) {
    most = count > 0 ? std::max<tmcmc::Index>(most, iterations) : most;
  }
  return most;
}

/// Share of a sampler's studies with a run that took at least so many iterations.
double share_with(const std::vector<StudySummary>& studies, const std::string& sampler,
                  tmcmc::Index iterations) {
  const auto own = studies_of(studies, sampler);
  const auto with = std::count_if(own.begin(), own.end(), [&](const StudySummary& s) {
    return s.iterations.lower_bound(iterations) != s.iterations.end();
  });
  return static_cast<double>(with) / static_cast<double>(own.size());
}

/// Number of runs of a study.
long runs_of(const std::vector<StudySummary>& studies) {
  const auto& counts = studies.at(0).iterations;
  return static_cast<long>(total_of({counts.begin(), counts.end()}));
}

double median_area(const std::vector<StudySummary>& studies) {
  std::vector<double> areas;
  for (const auto& s : studies) {
    areas.push_back(s.areas.at(0));
  }
  std::sort(areas.begin(), areas.end());
  return sample_quantile(areas, 0.5);
}

}  // namespace

Contrasts contrast_samplers(const std::vector<StudySummary>& studies,
                            const std::vector<PrintedColumn>& printed, std::uint64_t seed,
                            const TableDraws& draws) {
  if (printed.size() != 2) {
    throw errors::InvalidValue("printed", printed.size(), "columns of two samplers");
  }
  const PrintedColumn& first = printed[0];
  const PrintedColumn& second = printed[1];
  const auto of_areas = [&](std::size_t parameter) {
    return contrast_areas(studies, first.sampler, second.sampler, parameter,
                          second.areas.at(parameter) / first.areas.at(parameter), seed);
  };
  return {of_areas(0), of_areas(1),
          contrast_iterations(studies, first.counts, second.counts, first.sampler, second.sampler, draws)};
}

JudgedClaim judge_enclosure(const std::vector<StudySummary>& studies, const Truth& stated,
                            double exceedance) {
  double enclosing = 0.0;
  for (const auto& s : studies) {
    const bool force = s.smallest[0] <= stated.friction_force_n && s.largest[0] >= stated.friction_force_n;
    const bool frequency =
        s.smallest[1] <= stated.natural_frequency_hz && s.largest[1] >= stated.natural_frequency_hz;
    enclosing += force && frequency ? 1.0 : 0.0;
  }
  const double share = enclosing / static_cast<double>(studies.size());
  const bool most = share >= 0.5;
  const bool in_the_tail = exceedance < 0.025;
  return {most ? "reproduced" : "not reproduced",
          !most ? Verdict::contradicted : (in_the_tail ? Verdict::true_and_uninformative : Verdict::holds),
          fmt::format("the p-boxes hold both stated values in {:.0f} % of the studies; the exact posterior "
                      "gives P(F_mu > {} N) = {:.2g}{}",
                      100.0 * share, stated.friction_force_n, exceedance,
                      in_the_tail ? ": their ends reach it, whatever is true" : "")};
}

JudgedClaim judge_contrast(const ContrastVerdict& c, const std::string& what) {
  return {name_of(judge_chance(c.p)), judge_contrast(c.replicated),
          fmt::format("printed {} {:.3g}; two studies of one sampler: 95 % {:.3g} to {:.3g}, p = {:.2g} "
                      "(standard error {:.1g}); replicated samplers: ratio {:.4f} ({:.4f} to {:.4f}){}",
                      what, c.printed, c.interval.low, c.interval.high, c.p.value, c.p.standard_error,
                      c.replicated.ratio, c.replicated.interval.low, c.replicated.interval.high,
                      c.replicated.equivalent ? ", equivalent" : "")};
}

JudgedClaim judge_cause(const Contrasts& contrasts) {
  const bool one_algorithm = contrasts.friction_force.replicated.equivalent &&
                             contrasts.natural_frequency.replicated.equivalent &&
                             contrasts.iterations.replicated.equivalent;
  return {not_applicable, one_algorithm ? Verdict::contradicted : Verdict::not_supported,
          fmt::format("replicated, second sampler over first: median F_mu area {:.3f}, median omega_n area "
                      "{:.3f}, mean iterations {:.4f}; equivalent within {:.0f} %, {:.0f} % and {:.1f} %: {}",
                      contrasts.friction_force.replicated.ratio, contrasts.natural_frequency.replicated.ratio,
                      contrasts.iterations.replicated.ratio, 100.0 * area_margin, 100.0 * area_margin,
                      100.0 * iteration_margin, one_algorithm ? "yes" : "no")};
}

JudgedClaim judge_mode(const std::vector<PrintedColumn>& printed) {
  std::vector<std::string> modes;
  bool eleven = true;
  bool one_less = true;
  for (const auto& column : printed) {
    const auto mode = std::max_element(column.counts.begin(), column.counts.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    modes.push_back(fmt::format("{} ({} of {})", mode->first, mode->second, column.sampler));
    eleven = eleven && mode->first == iterations_in_text;
    one_less = one_less && mode->first == iterations_in_text - 1;
  }
  const std::string agree =
      "; they agree if one counts the transitions and the other beta_0 too, as the axis of the published "
      "plot, "
      "from 10 to 12, suggests";
  const Verdict verdict =
      eleven ? Verdict::holds : (one_less ? Verdict::off_by_one : Verdict::internally_contradictory);
  return {not_applicable, verdict,
          fmt::format("Table 4: most runs take {}, the text says {}{}", fmt::join(modes, " and "),
                      iterations_in_text, one_less ? agree : "")};
}

JudgedClaim judge_stated_force(const Audit& audit) {
  const auto& fit = audit.friction_force;
  const auto& test = fit.tests.front();
  const double critical = quantile(boost::math::chi_squared(1.0), 1.0 - significance_level);
  // NaN, where the motion would not be continuous, does not count as agreement either
  const bool agrees = test.likelihood_ratio < critical;
  return {
      not_applicable, agrees ? Verdict::not_rejected : Verdict::contradicted,
      fmt::format("chi^2 of Table 1, on {} observations: {:.1f} at {} N (p = {:.2g}), {:.1f} at the best "
                  "fit of {:.4f} N; likelihood ratio {:.1f}; with the noise unknown F = {:.1f}, p = {:.2g}{}",
                  audit.ratio_residual.size(), test.chi_squared, test.value, test.chi_squared_p,
                  fit.chi_squared, fit.estimate, test.likelihood_ratio, test.f_statistic, test.f_p,
                  agrees ? "" : "; if Table 1 is the data that were used")};
}

JudgedClaim judge_maximum(const std::vector<StudySummary>& studies,
                          const std::vector<PrintedColumn>& printed) {
  const tmcmc::Index first = most_iterations(printed.at(0));
  const tmcmc::Index second = most_iterations(printed.at(1));
  if (first >= second) {
    return {not_applicable, Verdict::internally_contradictory,
            fmt::format("Table 4: at most {} under {}, {} under {}", first, printed[0].sampler, second,
                        printed[1].sampler)};
  }
  const long runs = runs_of(studies);
  const PValue p = probability_of_none(studies, second, runs);
  const double share = share_with(studies, printed[0].sampler, second);
  return {name_of(judge_chance(p)), share >= 0.5 ? Verdict::contradicted : Verdict::holds,
          fmt::format("{:.0f} % of the replicated studies of {} hold a run of {} iterations or more; {} runs "
                      "hold none with probability {:.2g} (standard error {:.1g})",
                      100.0 * share, printed[0].sampler, second, runs, p.value, p.standard_error)};
}

JudgedClaim judge_iterations_as_evidence(const RankCorrelation& correlation) {
  const bool undefined = std::isnan(correlation.p);  // all runs took as many iterations
  const Verdict verdict = correlation.p < significance_level ? Verdict::holds : Verdict::does_not_follow;
  return {not_applicable, undefined ? Verdict::cannot_be_tested : verdict,
          fmt::format("rank correlation over runs of the iterations with the error of the mean of F_mu: "
                      "{:.2f}, p = {:.2g}",
                      correlation.rho, correlation.p)};
}

JudgedClaim judge_variability(double area, double floor) {
  return {not_applicable, area > 2.0 * floor ? Verdict::holds : Verdict::not_supported,
          fmt::format("median F_mu area of the studies {:.3f} N, of independent draws {:.4f} N: the rest is "
                      "mixing, of both samplers alike",
                      area, floor)};
}

JudgedClaim judge_noise(const Audit& audit) {
  const auto& fit = audit.friction_force;
  const bool rejected =
      fit.chi_squared_p < strict_significance || audit.ratio_chi_squared_p < strict_significance;
  return {not_applicable, rejected ? Verdict::contradicted : Verdict::not_rejected,
          fmt::format("ratios about their nominal values: chi^2 = {:.1f} on {}, p = {:.2g}; phases about the "
                      "best fit: chi^2 = {:.1f} on {}, p = {:.2g}",
                      audit.ratio_chi_squared, audit.ratio_residual.size(), audit.ratio_chi_squared_p,
                      fit.chi_squared, audit.ratio_residual.size() - 1, fit.chi_squared_p)};
}

const std::vector<std::string>& claim_ids() {
  static const std::vector<std::string> ids = {"C1", "C2",  "C3",  "C4",  "C5",  "C6",  "C7", "C8",
                                               "C9", "C10", "C11", "C12", "C13", "C14", "C15"};
  return ids;
}

JudgedClaim judge_claim(const std::string& id, const ClaimEvidence& e) {
  using Judge = std::function<JudgedClaim()>;
  const auto known = [](const char* number, Verdict verdict, const char* evidence) -> Judge {
    return [=] { return JudgedClaim{number, verdict, evidence}; };
  };
  const char* none = not_applicable.c_str();
  const std::map<std::string, Judge> judges = {
      {"C1", [&] { return judge_enclosure(e.studies, e.stated, e.exceedance); }},
      {"C2", [&] { return judge_contrast(e.contrasts.friction_force, "ratio"); }},
      {"C3", [&] { return judge_contrast(e.contrasts.natural_frequency, "ratio"); }},
      {"C4", [&] { return judge_contrast(e.contrasts.iterations, "deviance"); }},
      {"C5", [&] { return judge_cause(e.contrasts); }},
      {"C6", [&] { return judge_mode(e.printed); }},
      {"C7", [&] { return judge_stated_force(e.audit); }},
      {"C8", known(none, Verdict::contradicted,
                   "N_eff = N / (1 + CoV^2): both rules are one equation (criterion_identity)")},
      {"C9", known("not shown", Verdict::cannot_be_tested,
                   "the paper shows neither; see Figure 5 and Table 5 here")},
      {"C10", [&] { return judge_maximum(e.studies, e.printed); }},
      {"C11", [&] { return judge_iterations_as_evidence(e.iterations_and_error); }},
      {"C12", [&] { return judge_variability(median_area(e.studies), e.floor_n); }},
      {"C13",
       known(none, Verdict::holds_in_part,
             "Liu and Chen (1998) resample where the effective sample size falls below a threshold; as a "
             "rule for the length of a step it is that of Jasra et al. (2011)")},
      {"C14",
       known(none, Verdict::holds_in_part,
             "the scripts are public; the data files that they load, and the four files of runs, are not "
             "in their folder")},
      {"C15", [&] { return judge_noise(e.audit); }}};
  const auto judge = judges.find(id);
  if (judge == judges.end()) {
    throw errors::InvalidValue("id", id, "one of C1 to C15");
  }
  return judge->second();
}

std::vector<Statistic> claim_statistics(const ClaimEvidence& e, const JointTests& joint, double exact_mean,
                                        double exact_sd) {
  std::vector<Statistic> list;
  const auto add = [&](const char* quantity, double value, double error) {
    list.push_back({quantity, value, error});
  };
  const auto add_p = [&](const char* quantity, const PValue& p) { add(quantity, p.value, p.standard_error); };
  const auto& first = e.printed.at(0);
  const auto& second = e.printed.at(1);
  add_p("predictive p of the areas", joint.areas);
  add_p("predictive p of the counts", joint.counts);
  add_p("predictive p of the first column", joint.columns.at(0));
  add_p("predictive p of the second column", joint.columns.at(1));
  add_p("predictive p of all", joint.all);
  add_p("p of C2 and C4 together",
        combined_contrast(e.studies, second.areas.at(0) / first.areas.at(0), first.counts, second.counts));
  const Estimate iterations =
      difference_of_iterations(studies_of(e.studies, first.sampler), studies_of(e.studies, second.sampler));
  add("difference of mean iterations", iterations.value, iterations.standard_error);
  add("printed ratio of mean iterations", mean_iterations(second.counts) / mean_iterations(first.counts),
      not_a_number);
  const long runs = runs_of(e.studies);
  const tmcmc::Index most = most_iterations(second);
  add_p("p of no run with the most iterations", probability_of_none(e.studies, most, runs));
  add("share of studies with the most iterations", share_with(e.studies, first.sampler, most), not_a_number);
  add("rank correlation of iterations and error", e.iterations_and_error.rho, not_a_number);
  add("p of the rank correlation", e.iterations_and_error.p, not_a_number);
  const Estimate worth = independent_draws_worth(e.studies, runs, 0, exact_mean, exact_sd);
  add("chi^2 of the ratios", e.audit.ratio_chi_squared, not_a_number);
  add("bound of unlikely", significance_level, not_a_number);
  add("bound of very unlikely", strict_significance, not_a_number);
  add("independent draws that a run is worth", worth.value, worth.standard_error);
  return list;
}

}  // namespace replication
