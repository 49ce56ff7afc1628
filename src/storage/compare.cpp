#include "storage/compare.hpp"

#include <netcdf.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "errors/invalid_value.hpp"
#include "io/errors.hpp"

namespace storage {

namespace {

/// The posterior of a file opened for reading.
class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& path) : path_(path.string()) {
    const int opened = nc_open(path.c_str(), NC_NOWRITE, &file_);
    const int status = opened == NC_NOERR ? nc_inq_ncid(file_, "posterior", &id_) : opened;
    if (status != NC_NOERR) {
      if (opened == NC_NOERR) {
        nc_close(file_);
      }
      fail(std::string(nc_strerror(status)) +
           ": expected samples in NetCDF, as own_model --netcdf writes them");
    }
  }
  ~OpenFile() { nc_close(file_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  [[noreturn]] void fail(const std::string& what) const {
    throw io::InputError(io::printable_path(path_) + ": " + what);
  }

  [[nodiscard]] bool has(const char* attribute) const {
    return nc_inq_attid(id_, NC_GLOBAL, attribute, nullptr) == NC_NOERR;
  }

  [[nodiscard]] double number(const char* attribute) const {
    nc_type type = NC_NAT;
    std::size_t length = 0;
    double value = 0.0;
    if (nc_inq_att(id_, NC_GLOBAL, attribute, &type, &length) != NC_NOERR || length != 1 || type == NC_CHAR ||
        type == NC_STRING || nc_get_att_double(id_, NC_GLOBAL, attribute, &value) != NC_NOERR ||
        !std::isfinite(value)) {
      fail(std::string("attribute '") + attribute + "': expected a finite number");
    }
    return value;
  }

  /// A text attribute; empty if there is none.
  [[nodiscard]] std::string text(const char* attribute) const {
    nc_type type = NC_NAT;
    std::size_t length = 0;
    if (!has(attribute)) {
      return {};
    }
    nc_inq_att(id_, NC_GLOBAL, attribute, &type, &length);
    if (type == NC_STRING && length == 1) {  // as xarray writes them
      char* value = nullptr;
      if (nc_get_att_string(id_, NC_GLOBAL, attribute, &value) != NC_NOERR || value == nullptr) {
        return {};
      }
      std::string result = value;
      nc_free_string(1, &value);
      return result;
    }
    if (type != NC_CHAR) {
      fail(std::string("attribute '") + attribute + "': expected a text");
    }
    std::string value(length, '\0');
    return nc_get_att_text(id_, NC_GLOBAL, attribute, value.data()) == NC_NOERR ? value : std::string();
  }

 private:
  std::string path_;
  int file_ = -1;
  int id_ = -1;  // of the group of the posterior, which has the attributes in every file of ArviZ's layout
};

}  // namespace

StoredEvidence read_evidence(const std::filesystem::path& path) {
  const OpenFile file(path);
  StoredEvidence run{path.string(),
                     {file.number("log_evidence"), file.number("log_evidence_standard_error")},
                     file.text("data_checksum")};
  if (run.evidence.standard_error < 0.0) {
    file.fail("attribute 'log_evidence_standard_error': expected a number of at least 0");
  }
  if (file.has("beta") && file.number("beta") < 1.0) {
    file.fail("attribute 'beta': expected 1, a run that has reached the posterior");
  }
  return run;
}

void require_same_data(std::span<const StoredEvidence> runs) {
  for (const auto& run : runs) {
    if (run.data_checksum.empty()) {
      throw io::InputError(
          io::printable_path(run.path) +
          ": attribute 'data_checksum': expected the data of the run, which its model kept to itself; "
          "--same-data takes your word for it");
    }
    if (run.data_checksum != runs.front().data_checksum) {
      throw io::InputError(io::printable_path(run.path) + ": attribute 'data_checksum': value '" +
                           run.data_checksum + "': expected the same data as in " +
                           io::printable_path(runs.front().path) + ", '" + runs.front().data_checksum + "'");
    }
  }
}

std::vector<ComparedModel> compare(std::span<const tmcmc::Evidence> evidences,
                                   std::span<const double> prior_probabilities) {
  const auto require = [](bool condition, const char* field, double value, const char* expected) {
    if (!condition) {
      throw errors::InvalidValue(field, value, expected);
    }
  };
  require(!evidences.empty(), "evidences", 0.0, "at least one");
  require(prior_probabilities.empty() || prior_probabilities.size() == evidences.size(),
          "prior_probabilities", static_cast<double>(prior_probabilities.size()), "one for each model");
  const auto prior = [&](std::size_t i) {
    return prior_probabilities.empty() ? 1.0 : prior_probabilities[i];
  };
  std::size_t best = 0;
  for (std::size_t i = 0; i < evidences.size(); ++i) {
    require(std::isfinite(evidences[i].log_evidence), "log_evidence", evidences[i].log_evidence,
            "a finite number");
    require(evidences[i].standard_error >= 0.0 && std::isfinite(evidences[i].standard_error),
            "standard_error", evidences[i].standard_error, "a finite number of at least 0");
    require(prior(i) > 0.0 && std::isfinite(prior(i)), "prior_probabilities", prior(i), "positive numbers");
    best = evidences[i].log_evidence > evidences[best].log_evidence ? i : best;
  }
  double total = 0.0;
  std::vector<double> shares;
  for (std::size_t i = 0; i < evidences.size(); ++i) {
    shares.push_back(prior(i) * std::exp(evidences[i].log_evidence - evidences[best].log_evidence));
    total += shares.back();
  }
  double squares = 0.0;  // sum of (p_j s_j)^2
  for (std::size_t i = 0; i < evidences.size(); ++i) {
    shares[i] /= total;
    squares += shares[i] * shares[i] * evidences[i].standard_error * evidences[i].standard_error;
  }
  std::vector<ComparedModel> models;
  for (std::size_t i = 0; i < evidences.size(); ++i) {
    const double error = evidences[i].standard_error;
    const double p = shares[i];
    // d log p_i = ds_i - sum_j p_j ds_j, where s_j are independent errors of the log-evidences.
    const double variance = p * p * (error * error * (1.0 - 2.0 * p) + squares);
    models.push_back({evidences[i].log_evidence, error,
                      evidences[i].log_evidence - evidences[best].log_evidence,
                      i == best ? 0.0 : std::hypot(error, evidences[best].standard_error), p,
                      std::sqrt(std::max(variance, 0.0))});
  }
  return models;
}

}  // namespace storage
