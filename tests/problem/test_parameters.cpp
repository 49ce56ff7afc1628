#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "errors/invalid_value.hpp"
#include "io/temporary_directory.hpp"
#include "problem/parameters.hpp"
#include "tmcmc/distributions.hpp"
#include "tmcmc/sampler.hpp"

using Catch::Matchers::Contains;

namespace {

/// A problem file that is there as long as this is.
class Text {
 public:
  explicit Text(const std::string& text) { std::ofstream(path()) << text; }
  [[nodiscard]] std::string path() const { return (directory_.path() / "problem.toml").string(); }
  [[nodiscard]] tmcmc::Prior prior(const problem::ParameterRules& rules = {}) const {
    return problem::read_parameters(problem::read_file(path()), rules);
  }
  /// What is wrong, behind the path.
  [[nodiscard]] std::string refusal(const problem::ParameterRules& rules = {}) const {
    try {
      return "no error: " + prior(rules).text();
    } catch (const io::InputError& error) {
      const std::string message = error.what();
      return message.starts_with(path()) ? message.substr(path().size()) : "without its path: " + message;
    }
  }

 private:
  TemporaryDirectory directory_;
};

std::string refusal_of(const std::string& parameters) {
  return Text("[parameters]\n" + parameters + "\n").refusal();
}

}  // namespace

TEST_CASE("parameters keep the order of the file, their units and their distributions", "[problem]") {
  const Text text(R"(
[parameters]
zeta  = {lower = -1, upper = 2.5}
alpha = {distribution = "log_normal", mean = 0.9, sd = 0.3, unit = "N/m"}
[parameters.cut]
distribution = "truncated_normal"
sd = 1
mean = 0
lower = 0.5
[parameters."offset, mm"]
distribution = "beta"
alpha = 2.0
beta = 3.0
)");
  const tmcmc::Prior prior = text.prior();
  CHECK(prior.names() == std::vector<std::string>{"zeta", "alpha", "cut", "offset, mm"});
  CHECK(prior.units() == std::vector<std::string>{"", "N/m", "", ""});
  CHECK(prior.marginals()[0].text() == "uniform(-1, 2.5)");
  CHECK(prior.marginals()[1].text() == tmcmc::Marginal::log_normal_of_mean(0.9, 0.3).text());
  CHECK(prior.marginals()[2].text() == "truncated_normal(0, 1, 0.5, inf)");
  CHECK(prior.is_independent());
}

TEST_CASE("each distribution is stated by each of its sets of arguments", "[problem]") {
  for (const auto& form : tmcmc::distributions()) {
    std::string row = "x = {distribution = \"" + std::string(form.name) + "\"";
    std::vector<double> arguments;
    for (const auto name : form.arguments) {  // ascending, so that bounds and mode are in order
      arguments.push_back(0.5 * static_cast<double>(arguments.size() + 1));
      row += ", " + std::string(name) + " = " + std::to_string(arguments.back());
    }
    INFO(row);
    CHECK(Text("[parameters]\n" + row + "}\n").prior().marginals()[0].text() == form.make(arguments).text());
  }
}

TEST_CASE("correlations are those of parameters or of normal scores", "[problem]") {
  const std::string parameters =
      "[parameters]\na = {lower = 0, upper = 1}\nb = {lower = 0, upper = 1}\n"
      "c = {distribution = \"normal\", mean = 0, sd = 1}\n[correlation]\n";
  const Text scores(parameters + "of = \"normal_score\"\npairs = [[\"c\", \"a\", 0.5]]\n");
  const Text raw(parameters + "of = \"parameter\"\npairs = [[\"c\", \"a\", 0.5]]\n");
  std::vector<tmcmc::Parameter> same = {{"a", "", tmcmc::Marginal::uniform(0.0, 1.0)},
                                        {"b", "", tmcmc::Marginal::uniform(0.0, 1.0)},
                                        {"c", "", tmcmc::Marginal::normal(0.0, 1.0)}};
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(3, 3);
  matrix(0, 2) = matrix(2, 0) = 0.5;
  CHECK(scores.prior().text() == tmcmc::Prior(same, {matrix, tmcmc::CorrelationOf::normal_scores}).text());
  CHECK(raw.prior().text() == tmcmc::Prior(same, {matrix, tmcmc::CorrelationOf::parameters}).text());
  const auto refuse = [&](const std::string& rows) { return Text(parameters + rows).refusal(); };
  CHECK_THAT(refuse("of = \"rank\"\npairs = []\n"),
             Contains(":6: correlation.of: value 'rank': expected parameter or normal_score"));
  CHECK_THAT(refuse("pairs = []\n"), Contains(":5: correlation: expected the keys of and pairs"));
  for (const std::string pair :
       {"[\"c\", \"d\", 0.5]", "[\"c\", \"c\", 0.5]", "[\"c\", \"a\", 1]", "[\"c\", \"a\"]", "[1, 2, 3]"}) {
    CHECK_THAT(refuse("of = \"parameter\"\npairs = [\n" + pair + "]\n"),
               Contains(":8: correlation.pairs: value '[") &&
                   Contains("expected two parameters and a number between -1 and 1"));
  }
  CHECK_THAT(refuse("of = \"parameter\"\npairs = [[\"c\", \"a\", 0.99]]\n"),
             Contains(":7: correlation.pairs"));
  CHECK_THAT(refuse("of = \"normal_score\"\npairs = [[\"a\", \"b\", 0.9], [\"a\", \"c\", 0.9], [\"b\", "
                    "\"c\", -0.9]]\n"),
             Contains(":5: correlation: expected"));
}

TEST_CASE("what cannot be a parameter is refused with its line", "[problem]") {
  CHECK_THAT(refusal_of("x = 3"), Contains(":2: parameters.x: value '3': expected a table"));
  CHECK_THAT(refusal_of("x = {lower = 0}"),
             Contains(":2: parameters.x: uniform with 'lower': expected lower, upper, and perhaps unit"));
  CHECK_THAT(refusal_of("x = {lower = 0, uper = 1}"),
             Contains("uniform with 'lower, uper': expected lower, upper"));
  CHECK_THAT(
      refusal_of("x = {lower = 0, upper = \"1\"}"),
      Contains(":2: parameters.x.upper: value '1': expected a number, or the name of a parameter above"));
  CHECK_THAT(refusal_of("x = {lower = 0, upper = true}"),
             Contains("parameters.x.upper: value 'true': expected a number"));
  CHECK_THAT(refusal_of("x = {lower = 0, upper = nan}"),
             Contains("parameters.x.upper: value 'nan': expected a number"));
  CHECK_THAT(refusal_of("x = {lower = 0, upper = inf}"),
             Contains("parameters.x.upper: value 'inf': expected a number from -1e100 to 1e100"));
  CHECK_THAT(refusal_of("x = {lower = 0, upper = 1, unit = 3}"),
             Contains("parameters.x.unit: value '3': expected a text"));
  CHECK_THAT(refusal_of("\nx = {distribution = \"nomal\", mean = 0}"),
             Contains(":3: parameters.x.distribution: value 'nomal': expected uniform, "));
  CHECK_THAT(refusal_of("[parameters.x]\ndistribution = \"normal\"\nmean = 0\nsd = -1"),
             Contains(":5: parameters.x.sd: value '-1': expected"));
  CHECK_THAT(refusal_of("x = {lower = 2, upper = 1}"), Contains(":2: parameters.x"));
  CHECK_THAT(refusal_of("x = {lower = 0, upper = 1}\nx = {lower = 0, upper = 1}"),
             Contains(":3: ") && Contains("expected valid TOML"));
  CHECK_THAT(refusal_of("x = {lower = 0,"), Contains("expected valid TOML"));
  CHECK_THAT(refusal_of("x = 1979-05-27"), Contains(":2: a date or time"));
  CHECK_THAT(Text("").refusal(), Contains("no parameters: expected a table [parameters]"));
  const problem::ParameterRules rules{.names = {"a", "b"}, .nonnegative = true, .require_name = {}};
  const auto refuse = [&](const std::string& rows) { return Text("[parameters]\n" + rows).refusal(rules); };
  const std::string a = "a = {lower = 0, upper = 1}\n";
  CHECK_THAT(refuse(a), Contains(":1: parameters: no b: expected the parameters a, b"));
  CHECK_THAT(refuse(a + "c = {lower = 0, upper = 1}\n"),
             Contains(":3: parameters.c: expected the parameters a, b"));
  CHECK_THAT(refuse(a + "b = {lower = -1, upper = 1}\n"),
             Contains(":3: parameters.b: value '") && Contains("numbers of at least 0"));
  CHECK(Text("[parameters]\nb = {lower = 2, upper = 3}\n" + a).prior(rules).names() == rules.names);
  CHECK_THROWS_AS(problem::read_file("/no/such/file.toml"), io::InputError);
}

TEST_CASE("a hierarchical prior has the product of its conditional densities", "[problem]") {
  const Text text(R"([parameters]
mu = {distribution = "normal", mean = 1, sd = 2}
tau = {distribution = "half_normal", sd = 3}
theta = {distribution = "normal", mean = "mu", sd = "tau"}
share = {distribution = "uniform", lower = 0, upper = "tau"}
)");
  const tmcmc::Prior prior = text.prior();
  const tmcmc::Population draws = prior.sample(20000, {.seed = 3});
  const Eigen::VectorXd densities = prior.log_density(draws);
  for (Eigen::Index i = 0; i < 100; ++i) {
    const double mu = draws(i, 0), tau = draws(i, 1);
    CHECK(densities[i] == Approx(tmcmc::Marginal::normal(1.0, 2.0).log_density(mu) +
                                 tmcmc::Marginal::half_normal(3.0).log_density(tau) +
                                 tmcmc::Marginal::normal(mu, tau).log_density(draws(i, 2)) - std::log(tau)));
  }
  // E theta = 1 and Var theta = 4 + E tau^2 = 13, its fourth moment less than 20 times its square
  const auto theta = draws.col(2).array();
  CHECK(std::abs(theta.mean() - 1.0) < 5.0 * std::sqrt(13.0 / 20000.0));
  CHECK(std::abs((theta - 1.0).square().mean() - 13.0) < 5.0 * 13.0 * std::sqrt(20.0 / 20000.0));
  CHECK((draws.col(3).array() < draws.col(1).array()).all());
  tmcmc::Population outside(1, 4);
  outside << 1.0, 0.5, 1.0, 0.7;
  CHECK(prior.log_density(outside)[0] == -std::numeric_limits<double>::infinity());
}

TEST_CASE("hierarchies that cannot be are refused with the line", "[problem]") {
  const std::string mu = "mu = {distribution = \"normal\", mean = 0, sd = 1}\n";
  CHECK_THAT(
      refusal_of("x = {distribution = \"normal\", mean = \"mu\", sd = 1}\n" + mu),
      Contains(":2: parameters.x.mean: value 'mu': expected a number, or the name of a parameter above"));
  CHECK_THAT(refusal_of(mu + "x = {distribution = \"normal\", mean = 0, sd = \"mu\"}"),
             Contains(":3: parameters.x: draws from the prior give it sd = -"));
  CHECK_THAT(refusal_of(mu + "x = {distribution = \"normal\", mean = \"mu\", sd = 1}\n[correlation]\nof = "
                             "\"parameter\"\npairs = []"),
             Contains(":4: correlation: expected none"));
}
