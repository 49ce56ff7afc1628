/// \file
/// Points that a program writes beside its results, compared with the points it was given.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "io/csv.hpp"

namespace models {

/// Columns of a result table that have the names of parameters, in which the program has written
/// its points back.
class Echo {
 public:
  /// Looks for the columns in the table, which must outlive this object.
  /// \param parameter_names  one name for each column of the points
  Echo(const io::CsvTable& table, const std::vector<std::string>& parameter_names);

  /// What is wrong with a row, as "wrote stiffness_1 = 0.7 where the point has 0.9"; empty if it
  /// agrees.
  ///
  /// A number agrees if it is within one unit of its last printed digit, or within 2^-23 of the
  /// value (single precision).
  [[nodiscard]] std::string mismatch(Eigen::Index row, const Eigen::Ref<const Eigen::VectorXd>& point) const;

 private:
  const io::CsvTable& table_;
  std::vector<std::string> names_;
  std::vector<Eigen::Index> parameters_;
};

}  // namespace models
