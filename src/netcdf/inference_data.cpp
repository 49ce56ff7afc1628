#include "netcdf/inference_data.hpp"

#include <netcdf.h>
#include <netcdf_mem.h>

#include <cstdlib>
#include <memory>
#include <numeric>
#include <stdexcept>

namespace netcdf {

namespace {

void check(int status, const std::string& what) {
  if (status != NC_NOERR) {
    throw std::invalid_argument("NetCDF, " + what + ": " + nc_strerror(status));
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

  void variable(const std::string& name, const std::vector<int>& dimensions, const double* values) {
    int variable = 0;
    check(nc_def_var(id_, name.c_str(), NC_DOUBLE, static_cast<int>(dimensions.size()), dimensions.data(),
                     &variable),
          "variable " + name);
    check(nc_put_var_double(id_, variable, values), "variable " + name);
  }

  /// Columns of one length along one dimension.
  void columns(const std::string& along, const std::vector<Column>& columns) {
    if (columns.empty()) {
      return;
    }
    const int size = dimension(along, columns.front().second.size(), true);
    for (const auto& [name, values] : columns) {
      if (values.size() != columns.front().second.size()) {
        throw std::invalid_argument("column " + name + ": " + std::to_string(values.size()) +
                                    " values: expected " + std::to_string(columns.front().second.size()) +
                                    ", as in " + columns.front().first);
      }
      variable(name, {size}, values.data());
    }
  }

  [[nodiscard]] int id() const { return id_; }

 private:
  int id_ = 0;
};

void put_attributes(int id, const InferenceData& data) {
  for (const auto& [name, text] : data.texts) {
    check(nc_put_att_text(id, NC_GLOBAL, name.c_str(), text.size(), text.data()), "attribute " + name);
  }
  for (const auto& [name, number] : data.numbers) {
    check(nc_put_att_double(id, NC_GLOBAL, name.c_str(), NC_DOUBLE, 1, &number), "attribute " + name);
  }
}

void fill(int file, const InferenceData& data) {
  const auto draws = static_cast<std::size_t>(data.samples.rows());
  put_attributes(file, data);
  Group posterior(file, "posterior");
  const std::vector<int> chain_draw = {posterior.dimension("chain", 1, true),
                                       posterior.dimension("draw", draws, true)};
  for (std::size_t j = 0; j < data.parameter_names.size(); ++j) {
    posterior.variable(data.parameter_names[j], chain_draw,
                       data.samples.col(static_cast<Eigen::Index>(j)).data());
  }
  put_attributes(posterior.id(), data);

  Group statistics(file, "sample_stats");
  const std::vector<int> same = {statistics.dimension("chain", 1, true),
                                 statistics.dimension("draw", draws, true)};
  statistics.variable("log_likelihood", same, data.log_likelihood.data());
  statistics.columns("stage", data.stages);

  Group(file, "observed_data").columns("observation", data.observations);
}

}  // namespace

void write_inference_data(io::OutputFile& output, const InferenceData& data) {
  if (data.samples.cols() != static_cast<Eigen::Index>(data.parameter_names.size()) ||
      data.samples.rows() == 0 || data.log_likelihood.size() != data.samples.rows()) {
    throw std::invalid_argument(
        "inference data: expected samples with a column for each parameter name and a log-likelihood "
        "for each row");
  }
  int file = 0;
  check(nc_create_mem("inference_data", NC_NETCDF4, 0, &file), "file in memory");
  try {
    fill(file, data);
  } catch (...) {
    nc_abort(file);
    throw;
  }
  NC_memio memory{};
  check(nc_close_memio(file, &memory), "end of the file");
  const std::unique_ptr<void, decltype(&std::free)> owner(memory.memory, &std::free);
  output.write({static_cast<const char*>(memory.memory), memory.size});
}

}  // namespace netcdf
