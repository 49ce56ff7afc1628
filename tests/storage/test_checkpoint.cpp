// A run that was killed after any stage and goes on from its file ends with the same bits; a file
// that is not its own, or not whole, is refused.

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <boost/crc.hpp>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>

#include "io/errors.hpp"
#include "io/temporary_directory.hpp"
#include "storage/checkpoint.hpp"
#include "tmcmc/resumable.hpp"

namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using problems::ridge;
using resumable::check_same_bits;
using resumable::run_whole;
using storage::read_checkpoint;
using storage::RunDescription;
using storage::write_checkpoint;
using tmcmc::Index;
using tmcmc::Options;
using tmcmc::Progress;

Options small(bool diagnose = true) {
  Options options;
  options.samples = 12;
  options.scale_rule = tmcmc::FixedScale{0.8};
  options.max_stages = 2;
  options.diagnose = diagnose;
  return options;
}

RunDescription described(const Options& options) {
  return {options, {.seed = 5}, ridge().prior, "the ridge"};
}

void put(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::remove(path);  // some file systems flush a file that is overwritten
  std::ofstream(path, std::ios::binary) << text;
}

/// What a refusal says, without the file's name; "accepted" if there is none.
std::string refusal(const std::filesystem::path& path, const RunDescription& run) {
  try {
    static_cast<void>(read_checkpoint(path, run));
  } catch (const io::InputError& error) {
    const std::string message = error.what();
    CHECK(message.find('\n') == std::string::npos);
    CHECK_THAT(message, StartsWith(path.string() + ": "));
    return message.substr(path.string().size() + 2);
  }
  return "accepted";
}

/// A checkpoint of a small run after two stages.
struct Written {
  explicit Written(const Options& options = small()) : run(described(options)) {
    write_checkpoint(path, run, run_whole(options).progress.back());
    text = content(path);
  }
  TemporaryDirectory directory;
  std::filesystem::path path = directory.path() / "run.checkpoint";
  RunDescription run;
  std::string text;
};

constexpr std::size_t body_begins = sizeof "tmcmc checkpoint 3\n12345678";

/// A file with this body and a checksum that fits.
std::string forged(const std::string& body) {
  boost::crc_32_type crc;
  crc.process_bytes(body.data(), body.size());
  char sum[9];
  std::snprintf(sum, sizeof sum, "%08x", static_cast<unsigned>(crc.checksum()));
  return std::string("tmcmc checkpoint 3\n") + sum + "\n" + body;
}

}  // namespace

TEST_CASE("stopped after any stage, written, read and resumed: the run, for every kind of option",
          "[storage]") {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "run.checkpoint";
  for (auto [name, options] : resumable::every_kind()) {
    const auto whole = run_whole(options);
    for (std::size_t stage = 0; stage < whole.progress.size(); ++stage) {
      options.threads = 1;
      write_checkpoint(path, described(options), whole.progress[stage]);
      for (const int threads : {1, 3}) {
        CAPTURE(name, threads, stage);
        options.threads = threads;
        const auto read = read_checkpoint(path, described(options));
        REQUIRE(read.has_value());
        const auto& sums = read->bridge.sums();
        const auto& written = whole.progress[stage].bridge.sums();
        CHECK(sums.log_evidence == written.log_evidence);
        CHECK(sums.least_variance == written.least_variance);
        CHECK(sums.influence == written.influence);
        check_same_bits(tmcmc::resume(ridge(), options, {.seed = 5}, *read), whole.result);
      }
    }
  }
}

TEST_CASE("a run that dies at any evaluation and is started again and again is the run", "[storage]") {
  struct Killed {};
  for (const Index batch : {50, 400}) {
    const TemporaryDirectory directory;
    const auto path = directory.path() / "run.checkpoint";
    Options options = problems::few_samples();
    options.batch_rows = 50;
    const auto whole = run_whole(options);
    Index starts = 0;
    std::optional<tmcmc::Result> result;
    std::vector<Index> stages;
    while (!result) {
      Index left = batch + 40 * ++starts;  // rows until it dies
      try {
        result = storage::run_with_checkpoint(
            path, described(options),
            [&](const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Ref<Eigen::VectorXd> values) {
              left -= points.rows();
              if (left < 0) {
                throw Killed();
              }
              ridge().log_likelihood(points, values);
            },
            [&](const Progress& progress) { stages.push_back(progress.state.stage); });
      } catch (const Killed&) {
      }
    }
    CHECK(starts > 5);
    check_same_bits(*result, whole.result);
    for (std::size_t s = 0; s < stages.size(); ++s) {
      CHECK(stages[s] == static_cast<Index>(s));  // no stage was done twice
    }
    Index evaluated = 0;
    check_same_bits(storage::run_with_checkpoint(path, described(options),
                                                 [&](const Eigen::Ref<const Eigen::MatrixXd>& points,
                                                     Eigen::Ref<Eigen::VectorXd> values) {
                                                   evaluated += points.rows();
                                                   ridge().log_likelihood(points, values);
                                                 }),
                    whole.result);
    CHECK(evaluated == 3);  // to see that the model is the same
    CHECK(std::distance(std::filesystem::directory_iterator(directory.path()), {}) == 1);
  }
}

TEST_CASE("only the file of a checkpoint is removed", "[storage]") {
  namespace fs = std::filesystem;
  const Written written;
  const fs::path link = written.directory.path() / "link";
  fs::create_symlink("run.checkpoint", link);
  storage::remove_checkpoint(link);
  CHECK(fs::is_symlink(link));
  CHECK_FALSE(fs::exists(written.path));
  storage::remove_checkpoint(link);  // now without its file
  storage::remove_checkpoint(written.path);
  CHECK(fs::is_symlink(link));

  const fs::path pipe = written.directory.path() / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  storage::remove_checkpoint(pipe);
  CHECK(fs::exists(pipe));
  storage::remove_checkpoint(written.directory.path());
  CHECK(fs::exists(written.directory.path()));

  std::ofstream(written.path) << "what is printed";
  const int descriptor = ::open(written.path.c_str(), O_RDONLY);
  storage::remove_checkpoint("/dev/fd/" + std::to_string(descriptor));
  ::close(descriptor);
  CHECK(fs::exists(written.path));
}

TEST_CASE("numbers come back bit for bit, extreme ones too", "[storage]") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Written written(small(false));
  Progress progress = run_whole(small(false)).progress.back();
  const std::vector<double> extreme = {-infinity, -0.0,      5e-324, -1.7976931348623157e308,
                                       0.1,       1.0 / 3.0, 1e22};
  for (std::size_t i = 0; i < extreme.size(); ++i) {
    progress.state.log_likelihood[static_cast<Index>(i)] = extreme[i];
  }
  progress.stages[0].coefficient_of_variation = infinity;
  progress.state.log_evidence = std::nextafter(1.0, 2.0);
  write_checkpoint(written.path, written.run, progress);
  const auto read = read_checkpoint(written.path, written.run);
  REQUIRE(read.has_value());
  for (std::size_t i = 0; i < extreme.size(); ++i) {
    const double value = read->state.log_likelihood[static_cast<Index>(i)];
    CHECK(value == extreme[i]);
    CHECK(std::signbit(value) == std::signbit(extreme[i]));
  }
  CHECK(read->stages[0].coefficient_of_variation == infinity);
  CHECK(read->state.log_evidence == progress.state.log_evidence);
}

TEST_CASE("no file: nothing to go on from", "[storage]") {
  const TemporaryDirectory directory;
  CHECK_FALSE(read_checkpoint(directory.path() / "none", described(small())).has_value());
}

TEST_CASE("a checkpoint cut off at any byte is refused", "[storage][fault]") {
  const Written written;
  for (std::size_t size = 0; size < written.text.size(); ++size) {
    put(written.path, written.text.substr(0, size));
    CAPTURE(size);
    CHECK(refusal(written.path, written.run) != "accepted");
  }
  CHECK_THAT(refusal(written.path, written.run), StartsWith("damaged or cut off: expected another checksum"));
  put(written.path, written.text);
  CHECK(refusal(written.path, written.run) == "accepted");
}

TEST_CASE("a checkpoint with any bit flipped, or with more at its end, is refused", "[storage][fault]") {
  const Written written;
  for (std::size_t at = 0; at < written.text.size(); ++at) {
    std::string spoiled = written.text;
    spoiled[at] = static_cast<char>(spoiled[at] ^ (1 << (at % 8)));
    put(written.path, spoiled);
    CAPTURE(at);
    CHECK(refusal(written.path, written.run) != "accepted");
  }
  for (const std::string more : {"\n", "x", "crc32 = 00000000\n"}) {
    put(written.path, written.text + more);
    CHECK(refusal(written.path, written.run) != "accepted");
  }
  put(written.path, written.text + "x");
  CHECK(refusal(written.path, written.run) ==
        "damaged or cut off: expected another checksum (delete it to start again)");
}

TEST_CASE("another format and other files are told apart", "[storage][fault]") {
  const Written written;
  put(written.path, "x,y\n1,2\n");
  CHECK(refusal(written.path, written.run) ==
        "not a checkpoint: expected 'tmcmc checkpoint 3' in its first line");
  for (const std::string version : {"1", "2", "22", ""}) {
    put(written.path, "tmcmc checkpoint " + version + written.text.substr(written.text.find('\n')));
    CHECK(refusal(written.path, written.run) ==
          "checkpoint of format '" + version + "': expected format 3 (delete it to start again)");
  }
  CHECK_THAT(refusal(written.directory.path(), written.run), StartsWith("cannot be read"));
}

TEST_CASE("a checkpoint of other settings is refused with both values", "[storage][fault]") {
  const Written written;
  const auto with = [&](const std::function<void(RunDescription&)>& change) {
    RunDescription run = written.run;
    change(run);
    return refusal(written.path, run);
  };
  CHECK(with([](auto& r) { r.options.samples = 1000; }) ==
        "checkpoint was made with samples = 12, this run has 1000: expected the same, or another file");
  CHECK(with([](auto& r) { r.key.seed = 6; }) ==
        "checkpoint was made with seed = 5, this run has 6: expected the same, or another file");
  const std::vector<std::pair<std::string, std::function<void(RunDescription&)>>> changes = {
      {"criterion = coefficient-of-variation, this run has effective-sample-size",
       [](auto& r) { r.options.criterion.rule = tmcmc::EffectiveSampleSize{}; }},
      {"cov_target = 1, this run has 0.9",
       [](auto& r) { r.options.criterion.rule = tmcmc::CoefficientOfVariation{0.9}; }},
      {"deviation = population, this run has sample",
       [](auto& r) { r.options.criterion.deviation = tmcmc::Deviation::sample; }},
      {"counted = feasible, this run has all",
       [](auto& r) { r.options.criterion.counted = tmcmc::Counted::all; }},
      {"resampling = multinomial, this run has systematic",
       [](auto& r) { r.options.resampling = tmcmc::Resampling::systematic; }},
      {"move = resample-move, this run has waste-free",
       [](auto& r) { r.options.move = tmcmc::WasteFree{6}; }},
      {"move_steps = 3, this run has 4", [](auto& r) { r.options.move = tmcmc::ResampleMove{.steps = 4}; }},
      {"mixing_correlation = 0, this run has 0.1",
       [](auto& r) { r.options.move = tmcmc::ResampleMove{.mixing_correlation = 0.1}; }},
      {"scale_rule = fixed, this run has acceptance-linked",
       [](auto& r) { r.options.scale_rule = tmcmc::AcceptanceLinked{}; }},
      {"proposal_scale = 0.8, this run has 0.2", [](auto& r) { r.options.scale_rule = tmcmc::FixedScale{}; }},
      {"centre = weighted-mean, this run has plain-mean",
       [](auto& r) { r.options.centre = tmcmc::Centre::plain_mean; }},
      {"coordinates = natural, this run has unbounded",
       [](auto& r) {
         r.options.proposal = tmcmc::MetropolisProposal{.coordinates = tmcmc::Coordinates::unbounded};
       }},
      {"random_subsets = no, this run has yes",
       [](auto& r) { r.options.proposal = tmcmc::MetropolisProposal{.random_subsets = true}; }},
      {"independent_fraction = 0, this run has 0.5",
       [](auto& r) { r.options.proposal = tmcmc::MetropolisProposal{.independent_fraction = 0.5}; }},
      {"cross_fit = no, this run has yes", [](auto& r) { r.options.cross_fit = true; }},
      {"boundary = reject, this run has redraw", [](auto& r) { r.options.proposal = tmcmc::RedrawnWalk{}; }},
      {"infeasible_level = -inf, this run has -1000", [](auto& r) { r.options.infeasible_level = -1000.0; }},
      {"minimum_step = 1e-15, this run has 1e-10", [](auto& r) { r.options.minimum_step = 1e-10; }},
      {"evaluation_budget = 0, this run has 99", [](auto& r) { r.options.evaluation_budget = 99; }},
      {"finish = none, this run has independent",
       [](auto& r) { r.options.finish = tmcmc::IndependentDraws{}; }},
      {"diagnose = yes, this run has no", [](auto& r) { r.options.diagnose = false; }},
      {"study = 0, this run has 1", [](auto& r) { r.key.study = 1; }},
      {"arm = 0, this run has 1", [](auto& r) { r.key.arm = 1; }},
      {"run = 0, this run has 1", [](auto& r) { r.key.run = 1; }},
      {"prior.lower = -5 -5 -5, this run has -6 -5 -5",
       [](auto& r) {
         r.prior = {Eigen::Vector3d(-6, -5, -5), r.prior.upper()};
       }},
      {"prior.upper = 5 5 5, this run has 5 5 6",
       [](auto& r) {
         r.prior = {r.prior.lower(), Eigen::Vector3d(5, 5, 6)};
       }},
      {"model = the ridge, this run has the ridge\\x1B, with a crack",
       [](auto& r) { r.model += "\x1B, with a crack"; }}};
  for (const auto& [what, change] : changes) {
    CAPTURE(what);
    CHECK_THAT(with(change), StartsWith("checkpoint was made with " + what));
  }
  CHECK(changes.size() + 2 == storage::settings(written.run).size());
  CHECK(with([](auto& r) { r.options.threads = 3; }) == "accepted");
  CHECK(with([](auto& r) { r.options.batch_rows = 0; }) == "accepted");
  CHECK(with([](auto& r) { r.options.max_stages = 50; }) == "accepted");
  CHECK_THAT(with([](auto& r) { r.options.max_stages = 1; }),
             Contains("expected at most options.max_stages = 1, not 2"));
  CHECK_THROWS_WITH(storage::settings({small(), {}, ridge().prior, "two\nlines"}), Contains("one line"));
}

TEST_CASE("so is one of another argument of a move, a scale rule, a proposal or a criterion",
          "[storage][fault]") {
  Options options = small();
  options.criterion = tmcmc::effective_sample_size_rule(0.5);
  options.move = tmcmc::WasteFree{6};
  options.scale_rule = tmcmc::TargetAcceptance{0.3};
  options.proposal = tmcmc::RedrawnWalk{.max_redraws = 1000};
  const Written one(options);
  options.move = tmcmc::ResampleMove{.mixing_correlation = 0.5, .max_steps = 20};
  const Written two(options);
  const auto check = [](const Written& written, auto change, const std::string& what) {
    RunDescription run = written.run;
    change(run.options);
    CHECK_THAT(refusal(written.path, run), StartsWith("checkpoint was made with " + what));
  };
  check(
      one, [](Options& o) { o.criterion = tmcmc::effective_sample_size_rule(0.25); },
      "ess_fraction = 0.5, this run has 0.25");
  check(
      one, [](Options& o) { o.move = tmcmc::WasteFree{4}; }, "chains = 6, this run has 4");
  check(
      one, [](Options& o) { o.scale_rule = tmcmc::TargetAcceptance{0.4}; },
      "target_acceptance = 0.3, this run has 0.4");
  check(
      one, [](Options& o) { o.proposal = tmcmc::RedrawnWalk{7}; }, "max_redraws = 1000, this run has 7");
  check(
      two, [](Options& o) { std::get<tmcmc::ResampleMove>(o.move).max_steps = 9; },
      "max_move_steps = 20, this run has 9");
  check(
      two, [](Options& o) { std::get<tmcmc::ResampleMove>(o.move).mixing_correlation = 0.0; },
      "mixing_correlation = 0.5, this run has 0");
}

TEST_CASE("a file whose checksum fits is still read with care", "[storage][fault]") {
  const Written written;
  const std::string body = written.text.substr(body_begins);
  put(written.path, forged(body));
  CHECK(refusal(written.path, written.run) == "accepted");
  for (std::size_t size = 0; size < body.size(); ++size) {
    put(written.path, forged(body.substr(0, size)));
    CAPTURE(size);
    CHECK(refusal(written.path, written.run) ==
          "less than a checkpoint: expected more bytes (delete it to start again)");
  }
  put(written.path, forged(body + "x"));
  CHECK(refusal(written.path, written.run) ==
        "more than a checkpoint: expected its end (delete it to start again)");

  const Progress valid = run_whole(small()).progress.back();
  const std::vector<std::pair<std::string, std::function<void(Progress&)>>> changes = {
      {"stage", [](Progress& p) { p.state.stage = 3; }},
      {"beta", [](Progress& p) { p.state.beta = 1.5; }},
      {"chains", [](Progress& p) { p.state.genealogy.chains = 0; }},
      {"a log-likelihood too few", [](Progress& p) { p.state.log_likelihood.conservativeResize(11); }},
      {"a parameter too many", [](Progress& p) { p.state.points.conservativeResize(12, 4); }},
      {"a point outside the prior", [](Progress& p) { p.state.points(3, 1) = 6.0; }},
      {"a log-likelihood of NaN",
       [](Progress& p) { p.state.log_likelihood[5] = std::numeric_limits<double>::quiet_NaN(); }},
      {"an ancestor that is none", [](Progress& p) { p.state.genealogy.parents[0][0] = 12; }},
      {"a stage too few", [](Progress& p) { p.stages.pop_back(); }}};
  for (const auto& [what, change] : changes) {
    CAPTURE(what);
    Progress progress = valid;
    change(progress);
    write_checkpoint(written.path, written.run, progress);
    CHECK_THAT(refusal(written.path, written.run),
               Contains("expected") && Contains("(delete it to start again)"));
  }
}

TEST_CASE("a model that has changed since the checkpoint is refused, and nothing is touched",
          "[storage][fault]") {
  const Options options = small(false);
  const auto whole = run_whole(options);
  for (std::size_t stage = 0; stage < whole.progress.size(); ++stage) {
    for (const double change : {std::numeric_limits<double>::epsilon(), 1.0}) {
      CAPTURE(stage, change);
      const TemporaryDirectory directory;
      const auto path = directory.path() / "run.checkpoint";
      write_checkpoint(path, described(options), whole.progress[stage]);
      const std::string before = content(path);
      Index evaluated = 0;
      const auto changed = [&](const Eigen::Ref<const Eigen::MatrixXd>& points,
                               Eigen::Ref<Eigen::VectorXd> values) {
        evaluated += points.rows();
        ridge().log_likelihood(points, values);
        values[values.size() - 1] *= 1.0 + change;  // one sample is enough
      };
      CHECK_THROWS_WITH(
          storage::run_with_checkpoint(path, described(options), changed),
          StartsWith(path.string() + ": the model has changed: the log-likelihood of a sample in the "
                                     "checkpoint was -") &&
              Contains(" and is now -"));
      CHECK(evaluated == 3);
      CHECK(content(path) == before);
    }
  }
}

TEST_CASE("the checksum of a file is that of xz and sees every byte", "[storage]") {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "model.py";
  put(path, "123456789");
  CHECK(storage::file_checksum(path) == "995dc9bbdf1939fa");  // check value of CRC-64/XZ
  std::string large(200000, 'x');
  put(path, large);
  const std::string before = storage::file_checksum(path);
  large.back() = 'y';
  put(path, large);
  CHECK(storage::file_checksum(path) != before);
  CHECK_THROWS_WITH(storage::file_checksum(directory.path() / "none"), Contains("none: cannot be read"));
  CHECK_THROWS_AS(storage::file_checksum(directory.path()), io::InputError);
}

TEST_CASE("a path that cannot be written is found out before the first evaluation", "[storage][fault]") {
  const TemporaryDirectory directory;
  bool called = false;
  CHECK_THROWS_AS(
      storage::run_with_checkpoint(directory.path() / "none" / "run.checkpoint", described(small()),
                                   [&](const auto&, auto values) {
                                     called = true;
                                     values.setZero();
                                   }),
      io::OutputError);
  CHECK_FALSE(called);
}
