#include "distributed/ranks.hpp"

#include <string>

#include "distributed/transport.hpp"

namespace distributed {

Ranks::Ranks(int& argc, char**& argv) {
  transport::start(argc, argv);
  rank_ = transport::rank();
  size_ = transport::size();
}

Ranks::~Ranks() {
  transport::finish();
}

void Ranks::wait_until_all_are_ready() {
  if (ready_) {
    return;
  }
  ready_ = true;
  const int failed = transport::smallest(size_);
  if (failed < size_) {
    throw AnotherRankFailed("rank " + std::to_string(failed) + " failed before the work began");
  }
}

bool Ranks::reports_failure() {
  if (ready_) {
    return rank_ == 0;
  }
  ready_ = true;
  return transport::smallest(rank_) == rank_;
}

}  // namespace distributed
