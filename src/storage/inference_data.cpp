#include "storage/inference_data.hpp"

#include <fmt/format.h>
#include <netcdf.h>
#include <netcdf_mem.h>

#include <boost/crc.hpp>
#include <cstdlib>
#include <numeric>
#include <string_view>
#include <utility>

#include "errors/invalid_value.hpp"
#include "io/csv.hpp"

namespace storage {

namespace {

void check(int status, const std::string& what) {
  if (status != NC_NOERR) {
    throw errors::InvalidValue("NetCDF, " + what, nc_strerror(status), "what NetCDF-4 can hold");
  }
}

/// A group with its dimensions and variables.
class Group {
 public:
  Group(int file, const std::string& name) { check(nc_def_grp(file, name.c_str(), &id_), "group " + name); }

  int dimension(const std::string& name, std::size_t size, bool coordinates) {
    int dimension = 0;
    check(nc_def_dim(id_, name.c_str(), size, &dimension), "dimension " + name);
    if (coordinates) {
      std::vector<long long> indices(size);
      std::iota(indices.begin(), indices.end(), 0LL);
      int variable = 0;
      check(nc_def_var(id_, name.c_str(), NC_INT64, 1, &dimension, &variable), "coordinates " + name);
      check(nc_put_var_longlong(id_, variable, indices.data()), "coordinates " + name);
    }
    return dimension;
  }

  void variable(const std::string& name, const std::vector<int>& dimensions, const double* values,
                const std::string& unit = {}) {
    int variable = 0;
    check(nc_def_var(id_, name.c_str(), NC_DOUBLE, static_cast<int>(dimensions.size()), dimensions.data(),
                     &variable),
          "variable " + name);
    if (!unit.empty()) {
      check(nc_put_att_text(id_, variable, "units", unit.size(), unit.data()), "unit of " + name);
    }
    check(nc_put_var_double(id_, variable, values), "variable " + name);
  }

  /// Writes columns of equal length along one dimension.
  void columns(const std::string& along, const std::vector<Column>& columns) {
    if (columns.empty()) {
      return;
    }
    const int size = dimension(along, columns.front().second.size(), true);
    for (const auto& [name, values] : columns) {
      if (values.size() != columns.front().second.size()) {
        throw errors::InvalidValue(
            "values of " + name, std::to_string(values.size()),
            std::to_string(columns.front().second.size()) + ", as of " + columns.front().first);
      }
      variable(name, {size}, values.data());
    }
  }

  [[nodiscard]] int id() const { return id_; }

 private:
  int id_ = 0;
};

/// Checksum of the measurements, a CRC-64 of the numbers; empty if there are none.
std::string checksum_of(const std::vector<Column>& observed) {
  std::string text;
  for (const auto& [name, values] : observed) {
    for (const double value : values) {
      text += io::format_number(value) + ',';
    }
    text += '\n';
  }
  boost::crc_optimal<64, 0x42F0E1EBA9EA3693, ~0ULL, ~0ULL, true, true> crc;  // that of file_checksum()
  crc.process_bytes(text.data(), text.size());
  return text.empty() ? text : fmt::format("{:016x}", crc.checksum());
}

void put_attributes(int id, const InferenceData& data) {
  if (const std::string checksum = checksum_of(data.observed); !checksum.empty()) {
    check(nc_put_att_text(id, NC_GLOBAL, "data_checksum", checksum.size(), checksum.data()),
          "attribute data_checksum");
  }
  for (const auto& [name, text] : data.texts) {
    check(nc_put_att_text(id, NC_GLOBAL, name.c_str(), text.size(), text.data()), "attribute " + name);
  }
  for (const auto& [name, number] : data.numbers) {
    check(nc_put_att_double(id, NC_GLOBAL, name.c_str(), NC_DOUBLE, 1, &number), "attribute " + name);
  }
}

void fill(int file, const InferenceData& data) {
  const auto chains = static_cast<std::size_t>(data.chains);
  const std::size_t draws = static_cast<std::size_t>(data.samples.rows()) / chains;
  put_attributes(file, data);
  Group posterior(file, "posterior");
  const std::vector<int> chain_draw = {posterior.dimension("chain", chains, true),
                                       posterior.dimension("draw", draws, true)};
  for (std::size_t j = 0; j < data.parameter_names.size(); ++j) {
    posterior.variable(data.parameter_names[j], chain_draw,
                       data.samples.col(static_cast<Eigen::Index>(j)).data(),
                       data.parameter_units.empty() ? std::string() : data.parameter_units[j]);
  }
  put_attributes(posterior.id(), data);

  Group statistics(file, "sample_stats");
  const std::vector<int> same = {statistics.dimension("chain", chains, true),
                                 statistics.dimension("draw", draws, true)};
  statistics.variable("lp", same, data.log_likelihood.data());
  statistics.columns("stage", data.stages);

  if (!data.pointwise_log_likelihood.empty()) {
    Group group(file, "log_likelihood");
    std::vector<int> dimensions = {group.dimension("chain", chains, true),
                                   group.dimension("draw", draws, true)};
    const Eigen::Index observations = data.pointwise_log_likelihood.front().second.cols();
    dimensions.push_back(group.dimension("observation", static_cast<std::size_t>(observations), true));
    for (const auto& [name, values] : data.pointwise_log_likelihood) {
      if (values.rows() != data.samples.rows() || values.cols() != observations) {
        throw errors::InvalidValue("log-likelihoods of " + name,
                                   std::to_string(values.rows()) + " x " + std::to_string(values.cols()),
                                   "a row for each sample and a column for each observation");
      }
      const Eigen::MatrixXd draw_by_draw = values.transpose();
      group.variable(name, dimensions, draw_by_draw.data());
    }
  }
  for (const auto& [name, columns] :
       {std::pair{"observed_data", &data.observed}, {"constant_data", &data.constant}}) {
    if (!columns->empty()) {
      Group(file, name).columns("observation", *columns);
    }
  }
}

/// A file written in memory.
class MemoryFile {
 public:
  MemoryFile() { check(nc_create_mem("inference_data", NC_NETCDF4, 0, &id_), "file in memory"); }
  ~MemoryFile() {
    if (id_ >= 0) {
      nc_abort(id_);
    }
    std::free(bytes_.memory);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] int id() const { return id_; }

  /// Ends the file; its bytes are valid as long as this object.
  std::string_view finish() {
    check(nc_close_memio(std::exchange(id_, -1), &bytes_), "end of the file");
    return {static_cast<const char*>(bytes_.memory), bytes_.size};
  }

 private:
  int id_ = -1;
  NC_memio bytes_{};
};

}  // namespace

void require_parameter_name(const std::string& name) {
  const MemoryFile file;
  const Group posterior(file.id(), "posterior");
  int variable = 0;
  if (name == "chain" || name == "draw" ||
      nc_def_var(posterior.id(), name.c_str(), NC_DOUBLE, 0, nullptr, &variable) != NC_NOERR) {
    throw errors::InvalidValue(
        "parameter_name", name,
        "a name that NetCDF allows, other than chain and draw: a letter, digit or _ first, "
        "no / and no blank at the end");
  }
}

void write_inference_data(io::OutputFile& output, const InferenceData& data) {
  if (data.samples.cols() != static_cast<Eigen::Index>(data.parameter_names.size()) ||
      data.samples.rows() == 0 || data.log_likelihood.size() != data.samples.rows()) {
    throw errors::InvalidValue(
        "samples", std::to_string(data.samples.rows()) + " x " + std::to_string(data.samples.cols()),
        "a column for each parameter name and a log-likelihood for each row");
  }
  if (data.chains < 1 || data.samples.rows() % data.chains != 0) {
    throw errors::InvalidValue("chains", data.chains, "a divisor of the number of samples");
  }
  if (!data.parameter_units.empty() && data.parameter_units.size() != data.parameter_names.size()) {
    throw errors::InvalidValue("parameter_units", data.parameter_units.size(),
                               "one for each parameter, or none");
  }
  MemoryFile file;
  fill(file.id(), data);
  output.write(file.finish());
}

}  // namespace storage
