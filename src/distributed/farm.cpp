#include "distributed/farm.hpp"

#include <chrono>
#include <exception>
#include <future>
#include <map>
#include <thread>
#include <vector>

#include "distributed/transport.hpp"
#include "tmcmc/types.hpp"

namespace distributed {

namespace {

enum Tag : int { task, stop, done, failed, failed_sampling, failed_prior, stopped };

/// Waiting without a processor to itself: MPI's own waiting takes one for each rank.
class Patience {
 public:
  void wait() {
    constexpr int yields = 100;
    if (++waited_ < yields) {
      std::this_thread::yield();
    } else {
      std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
  }
  void renew() { waited_ = 0; }

 private:
  int waited_ = 0;
};

struct Outcome {
  std::string result;
  std::exception_ptr failure;
};

void work_and_answer(const Work& work, const std::string& bytes) {
  Tag tag = done;
  std::string answer;
  try {
    answer = work(bytes);
  } catch (const tmcmc::InfeasiblePriorError& error) {
    tag = failed_prior;
    answer = error.what();
  } catch (const tmcmc::SamplingError& error) {
    tag = failed_sampling;
    answer = error.what();
  } catch (const std::exception& error) {
    tag = failed;
    answer = error.what();
  }
  transport::send(0, tag, answer);
}

Outcome outcome_of(Message message) {
  switch (message.tag) {
    case done:
      return {std::move(message.bytes), nullptr};
    case failed_prior:
      return {{}, std::make_exception_ptr(tmcmc::InfeasiblePriorError(message.bytes))};
    case failed_sampling:
      return {{}, std::make_exception_ptr(tmcmc::SamplingError(message.bytes))};
    default:
      return {{}, std::make_exception_ptr(std::runtime_error(message.bytes))};
  }
}

void serve(const Work& work) {
  Patience patience;
  while (true) {
    const auto message = transport::receive();
    if (!message) {
      patience.wait();
    } else if (message->tag == stop) {
      transport::send(0, stopped, {});
      return;
    } else {
      work_and_answer(work, message->bytes);
      patience.renew();
    }
  }
}

/// Which task each rank is at, and what has come back.
class Dispatcher {
 public:
  Dispatcher(int ranks, const Work& work) : work_(work), task_of_(static_cast<std::size_t>(ranks)) {}

  /// Hands out tasks while there are some and ranks are free. After a failure no more.
  void hand_out(const std::function<std::optional<std::string>()>& next) {
    for (std::size_t rank = task_of_.size(); rank-- > 0 && !exhausted_;) {  // this rank last
      if (task_of_[rank]) {
        continue;
      }
      auto bytes = next();
      if (!bytes) {
        exhausted_ = true;
        return;
      }
      task_of_[rank] = handed_out_++;
      ++busy_;
      if (rank == 0) {
        local_ = std::async(std::launch::async, [this, mine = std::move(*bytes)] { return work_(mine); });
      } else {
        transport::send(static_cast<int>(rank), task, *bytes);
      }
    }
  }

  /// Takes what has come back; false if nothing has.
  bool take() {
    bool found = false;
    while (auto message = transport::receive()) {
      const auto rank = static_cast<std::size_t>(message->from);
      keep(rank, outcome_of(std::move(*message)));
      found = true;
    }
    if (local_.valid() && local_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
      Outcome outcome;
      try {
        outcome.result = local_.get();
      } catch (...) {
        outcome.failure = std::current_exception();
      }
      keep(0, std::move(outcome));
      found = true;
    }
    return found;
  }

  /// Passes on the results that are next in order. At a failure it stops for good.
  void pass_on(const std::function<void(std::string)>& collect) {
    for (auto first = outcomes_.begin(); first != outcomes_.end() && first->first == passed_on_;
         first = outcomes_.erase(first), ++passed_on_) {
      if (first->second.failure) {
        return;
      }
      collect(std::move(first->second.result));
    }
  }

  [[nodiscard]] bool busy() const { return busy_ > 0; }

  void rethrow() const {
    if (!outcomes_.empty()) {
      std::rethrow_exception(outcomes_.begin()->second.failure);
    }
  }

 private:
  void keep(std::size_t rank, Outcome outcome) {
    exhausted_ = exhausted_ || outcome.failure;
    outcomes_.emplace(*task_of_[rank], std::move(outcome));
    task_of_[rank].reset();
    --busy_;
  }

  const Work& work_;
  std::vector<std::optional<std::size_t>> task_of_;  // of each rank
  std::map<std::size_t, Outcome> outcomes_;          // not passed on yet
  std::size_t handed_out_ = 0;
  std::size_t passed_on_ = 0;
  std::size_t busy_ = 0;
  bool exhausted_ = false;
  std::future<std::string> local_;  // last: its destructor waits for what uses the rest
};

}  // namespace

void Farm::run(const std::function<std::optional<std::string>()>& next,
               const std::function<void(std::string)>& collect) {
  if (ranks_.size() == 1) {
    while (auto bytes = next()) {
      collect(work_(*bytes));
    }
    return;
  }
  Dispatcher dispatcher(ranks_.size(), work_);
  Patience patience;
  const auto take_or_wait = [&] {
    const bool found = dispatcher.take();
    found ? patience.renew() : patience.wait();
    return found;
  };
  try {
    dispatcher.hand_out(next);
    while (dispatcher.busy()) {
      if (take_or_wait()) {
        dispatcher.hand_out(next);  // first, since collecting may take its time
        dispatcher.pass_on(collect);
      }
    }
  } catch (...) {  // results still on their way would be taken for those of the next call
    while (dispatcher.busy()) {
      take_or_wait();
    }
    throw;
  }
  dispatcher.rethrow();
}

Farm::~Farm() {
  for (int rank = 1; rank < ranks_.size(); ++rank) {
    transport::send(rank, stop, {});
  }
  Patience patience;
  for (int left = ranks_.size() - 1; left > 0;) {
    const auto message = transport::receive();
    if (!message) {
      patience.wait();
    } else if (message->tag == stopped) {
      --left;
    }
  }
}

void lead_or_serve(Ranks& ranks, const Work& work, const std::function<void(Farm&)>& lead) {
  ranks.wait_until_all_are_ready();
  if (ranks.rank() > 0) {
    serve(work);
    return;
  }
  Farm farm(ranks, work);
  lead(farm);
}

}  // namespace distributed
