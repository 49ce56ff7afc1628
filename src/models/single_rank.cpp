#include "models/ranks.hpp"

namespace models {

Ranks::Ranks(int&, char**&) {}

Ranks::~Ranks() = default;

std::optional<tmcmc::LogLikelihood> Ranks::share(const tmcmc::LogLikelihood& model) {
  return model;
}

std::optional<SharedModel> Ranks::share(const tmcmc::LogLikelihood& model, const ForwardModel& outputs) {
  return SharedModel{model, outputs};
}

}  // namespace models
