#include "replication/claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <string>

#include "errors/invalid_value.hpp"

namespace replication {

namespace {

double printed_area(const std::vector<PrintedArea>& areas, const std::string& sampler,
                    std::size_t parameter) {
  const auto found = std::find_if(areas.begin(), areas.end(), [&](const PrintedArea& a) {
    return a.sampler == sampler && a.parameter == parameter;
  });
  if (found == areas.end()) {
    throw errors::InvalidValue("areas", sampler, "the printed areas of both parameters");
  }
  return std::stod(found->printed);
}

}  // namespace

Contrasts contrast_samplers(const std::vector<StudySummary>& studies, const std::vector<PrintedArea>& areas,
                            const std::vector<PrintedCounts>& counts, std::uint64_t seed,
                            const TableDraws& draws) {
  if (counts.size() != 2) {
    throw errors::InvalidValue("counts", counts.size(), "those of two samplers");
  }
  const std::string& first = counts[0].sampler;
  const std::string& second = counts[1].sampler;
  const auto of_areas = [&](std::size_t parameter) {
    return contrast_areas(studies, first, second, parameter,
                          printed_area(areas, second, parameter) / printed_area(areas, first, parameter),
                          seed);
  };
  return {of_areas(0), of_areas(1),
          contrast_iterations(studies, counts[0].counts, counts[1].counts, first, second, seed, draws)};
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
  return {share >= 0.5 ? "reproduced" : "not reproduced",
          exceedance < 0.025 ? Verdict::not_supported : Verdict::reproduced,
          fmt::format("the ends of the p-boxes hold both stated values in {:.0f} % of the studies, but the "
                      "exact posterior "
                      "gives P(F_mu > {} N) = {:.2g}: the p-box reaches it in its tail alone",
                      100.0 * share, stated.friction_force_n, exceedance)};
}

JudgedClaim judge_contrast(const ContrastVerdict& c, const std::string& what) {
  return {name_of(judge_number(c.p)), judge_contrast(c.p, c.replicated),
          fmt::format(
              "printed {} {:.3g}, null 95 % {:.3g} to {:.3g}, p = {:.2g} (standard error {:.1g}); replicated "
              "ratio of medians {:.3f} ({:.3f} to {:.3f})",
              what, c.printed, c.interval.low, c.interval.high, c.p.value, c.p.standard_error,
              c.replicated.ratio, c.replicated.interval.low, c.replicated.interval.high)};
}

JudgedClaim judge_cause(const Contrasts& contrasts) {
  const bool one_algorithm = contrasts.friction_force.replicated.equivalent &&
                             contrasts.natural_frequency.replicated.equivalent &&
                             contrasts.iterations.replicated.equivalent;
  return {"not applicable", one_algorithm ? Verdict::contradicted : Verdict::not_supported,
          fmt::format("replicated medians, second sampler over first: F_mu area {:.3f}, omega_n area {:.3f}, "
                      "iterations {:.4f}; equivalent within {:.0f} %, {:.0f} % and {:.0f} %: {}",
                      contrasts.friction_force.replicated.ratio, contrasts.natural_frequency.replicated.ratio,
                      contrasts.iterations.replicated.ratio, 100.0 * area_margin, 100.0 * area_margin,
                      100.0 * iteration_margin, one_algorithm ? "yes" : "no")};
}

JudgedClaim judge_mode(const std::vector<PrintedCounts>& printed) {
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

JudgedClaim judge_stated_force(const Audit& audit) {
  const auto& fit = audit.friction_force;
  const auto& test = fit.tests.front();
  const double critical = quantile(boost::math::chi_squared(1.0), 1.0 - significance_level);
  // NaN, where the motion would not be continuous, is no agreement either
  return {
      "not applicable", test.likelihood_ratio < critical ? Verdict::reproduced : Verdict::contradicted,
      fmt::format(
          "chi^2 of Table 1 is {:.1f} at {} N and {:.1f} at the least-squares estimate of {:.3f} N, on {} "
          "observations; likelihood ratio {:.1f}, 5 % bound {:.2f}, p = {:.1g}",
          test.chi_squared, test.value, fit.chi_squared, fit.estimate, audit.ratio_residual.size(),
          test.likelihood_ratio, critical, test.likelihood_ratio_p)};
}

JudgedClaim judge_claim(const std::string& id, const ClaimEvidence& e) {
  if (id == "C1") return judge_enclosure(e.studies, e.stated, e.exceedance);
  if (id == "C2") return judge_contrast(e.contrasts.friction_force, "ratio");
  if (id == "C3") return judge_contrast(e.contrasts.natural_frequency, "ratio");
  if (id == "C4") return judge_contrast(e.contrasts.iterations, "deviance");
  if (id == "C5") return judge_cause(e.contrasts);
  if (id == "C6") return judge_mode(e.counts);
  if (id == "C7") return judge_stated_force(e.audit);
  if (id == "C8") {
    return {"not applicable", Verdict::contradicted,
            "N_eff = N / (1 + CoV^2): both rules are one equation (criterion_identity)"};
  }
  if (id == "C9") {
    return {"not shown", Verdict::cannot_be_tested, "the paper shows neither; see Figure 5 and Table 5 here"};
  }
  throw errors::InvalidValue("id", id, "one of C1 to C9");
}

}  // namespace replication
