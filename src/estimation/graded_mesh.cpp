#include "estimation/graded_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace estimation {

std::vector<double> graded_mesh(double lower, double upper, const std::vector<double>& modes,
                                const std::vector<double>& separators,
                                const std::function<double(double, double)>& drop) {
  std::vector<double> mesh;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const double mode = modes[i];
    for (const double end :
         {i == 0 ? lower : separators[i - 1], i + 1 == modes.size() ? upper : separators[i]}) {
      const double smallest =
          4.0 * std::numeric_limits<double>::epsilon() * std::max(std::fabs(mode), std::fabs(end));
      double fraction = 1.0;
      while (std::fabs(fraction * (end - mode)) > smallest &&
             drop(mode, mode + fraction * (end - mode)) > 1.0) {
        fraction *= 0.5;
      }
      while (fraction < 1.0) {
        mesh.push_back(mode + fraction * (end - mode));
        fraction *= 2.0;
      }
      mesh.push_back(end);
    }
    mesh.push_back(mode);
  }
  std::sort(mesh.begin(), mesh.end());
  mesh.erase(std::unique(mesh.begin(), mesh.end()), mesh.end());
  return mesh;
}

}  // namespace estimation
