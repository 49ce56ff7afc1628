#include "models/json_connection.hpp"

#include <httplib.h>
#include <netinet/tcp.h>

#undef _res  // of <resolv.h>, a name that Eigen uses

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "errors/invalid_value.hpp"
#include "io/csv.hpp"
#include "io/interrupt.hpp"
#include "models/model_error.hpp"

namespace models {
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr double longest_timeout_seconds = 2e6;  // that httplib's milliseconds hold
constexpr std::chrono::seconds connection_timeout(30);
constexpr std::chrono::milliseconds longest_idle(100);
constexpr std::size_t longest_body = 200;

/// The position after a string whose opening quotation mark is at `at`.
std::size_t after_string(const std::string& text, std::size_t at) {
  for (++at; at < text.size() && text[at] != '"'; ++at) {
    at += text[at] == '\\' ? 1 : 0;
  }
  return std::min(at + 1, text.size());
}

/// Parses the JSON of a text. Python writes infinities and NaN, which are not valid JSON, as words
/// (its json module writes -Infinity, its lists -inf); these are converted to texts.
json parse(const std::string& text) {
  json value = json::parse(text, nullptr, false);
  if (!value.is_discarded()) {
    return value;
  }
  static const std::pair<std::string, std::string> words[] = {
      {"-Infinity", "\"-Infinity\""}, {"-inf", "\"-Infinity\""}, {"Infinity", "\"Infinity\""},
      {"inf", "\"Infinity\""},        {"NaN", "\"NaN\""},        {"nan", "\"NaN\""}};
  std::string mended;
  for (std::size_t at = 0; at < text.size();) {
    const auto word = std::find_if(std::begin(words), std::end(words), [&](const auto& w) {
      return text.compare(at, w.first.size(), w.first) == 0;
    });
    const std::size_t next = text[at] == '"'           ? after_string(text, at)
                             : word != std::end(words) ? at + word->first.size()
                                                       : at + 1;
    mended += word != std::end(words) ? word->second : text.substr(at, next - at);
    at = next;
  }
  return json::parse(mended, nullptr, false);
}

std::string text_of(const json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() ? "none"
         : found->is_string()  ? io::printable(found->get<std::string>(), longest_body)
                               : io::printable(found->dump(), longest_body);
}

/// The text of an answer with another status: cpp-httplib's servers put the message of an exception
/// into a header.
std::string words_of(const httplib::Response& answer) {
  const std::string words =
      answer.has_header("EXCEPTION_WHAT") ? answer.get_header_value("EXCEPTION_WHAT") : answer.body;
  return words.empty() ? "" : fmt::format(" ({})", io::printable(words, longest_body));
}

bool is_gateway_failure(int status) {
  return status == 502 || status == 503 || status == 504;
}

void wait_interruptibly(Seconds time) {
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(time);
  while (Clock::now() < end) {
    io::stop_if_interrupted();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

}  // namespace

/// The HTTP client, with a thread that aborts its waiting at an interrupt and closes an idle
/// connection.
struct JsonConnection::Http {
  httplib::Client client;
  std::string path;
  std::mutex in_use;
  Clock::time_point last_use = Clock::now();
  std::jthread watcher;

  Http(const std::string& host, std::string path_of_url) : client(host), path(std::move(path_of_url)) {
    watcher = std::jthread([this](const std::stop_token& stop) {
      std::mutex mutex;
      std::condition_variable_any condition;
      std::unique_lock lock(mutex);
      while (!condition.wait_for(lock, stop, std::chrono::milliseconds(50),
                                 [&] { return stop.stop_requested(); })) {
        const std::unique_lock idle(in_use, std::try_to_lock);
        if (io::interrupt_signal() != 0 || (idle && Clock::now() - last_use > longest_idle)) {
          client.stop();
        }
      }
    });
  }

  template <class Send>
  httplib::Result use(const Send& send) {
    const std::lock_guard lock(in_use);
    httplib::Result result = send();
    last_use = Clock::now();
    return result;
  }
};

JsonConnection::JsonConnection(const ServerOptions& options) : options_(options) {
  const std::string scheme = "http://";
  if (!options.url.starts_with(scheme) || options.url.size() == scheme.size()) {
    throw errors::InvalidValue("url", io::printable(options.url), "http://HOST[:PORT][/PATH]");
  }
  if (options.retries < 0) {
    throw errors::InvalidValue("retries", options.retries, "at least 0");
  }
  if (!(options.timeout_seconds >= 0.0) || !std::isfinite(options.timeout_seconds)) {
    throw errors::InvalidValue("timeout_seconds", options.timeout_seconds, "a finite number of at least 0");
  }
  const std::size_t slash = std::min(options.url.find('/', scheme.size()), options.url.size());
  std::string path = options.url.substr(slash);
  path.erase(path.find_last_not_of('/') + 1);
  http_ = std::make_unique<Http>(options.url.substr(0, slash), std::move(path));
  const double seconds = options.timeout_seconds > 0.0 ? options.timeout_seconds : longest_timeout_seconds;
  http_->client.set_read_timeout(std::chrono::duration_cast<std::chrono::microseconds>(
      Seconds(std::min(seconds, longest_timeout_seconds))));
  http_->client.set_connection_timeout(connection_timeout);
  http_->client.set_tcp_nodelay(true);
  http_->client.set_keep_alive(true);
}

JsonConnection::~JsonConnection() = default;

template <class Send>
json JsonConnection::request(const Send& send) {
  Seconds wait(0.1);
  for (int attempt = 0;; ++attempt, wait *= 2.0, ++repeated_) {
    io::stop_if_interrupted();
    const auto start = Clock::now();
    const httplib::Result result = http_->use(send);
    io::stop_if_interrupted();
    if (!result && result.error() == httplib::Error::Read && options_.timeout_seconds > 0.0 &&
        Seconds(Clock::now() - start).count() >= options_.timeout_seconds) {
      throw ModelError(fmt::format("took more than {} s", io::format_number(options_.timeout_seconds)));
    }
    json answer = result ? parse(result->body) : json();
    const bool has_error = answer.is_object() && answer.contains("error");
    if (result && !(is_gateway_failure(result->status) && !has_error)) {
      if (has_error) {
        throw ModelError(fmt::format("answered with the error {}: {}", text_of(answer["error"], "type"),
                                     text_of(answer["error"], "message")));
      }
      if (result->status != 200) {
        throw ModelError(
            fmt::format("answered with the status {}{}: expected 200", result->status, words_of(*result)));
      }
      if (!answer.is_object()) {
        throw ModelError(
            fmt::format("answered '{}': expected a JSON object", io::printable(result->body, longest_body)));
      }
      return answer;
    }
    if (attempt == options_.retries) {
      throw ModelError(fmt::format("could not be reached in {} attempts: {}", attempt + 1,
                                   result ? fmt::format("status {} of a gateway", result->status)
                                          : "error '" + httplib::to_string(result.error()) + "'"));
    }
    wait_interruptibly(wait);
  }
}

json JsonConnection::get(const std::string& path) {
  return request([&] { return http_->client.Get(http_->path + path); });
}

json JsonConnection::post(const std::string& path, const json& body) {
  const std::string text = body.dump();
  const auto send_body = [&](std::size_t, std::size_t, httplib::DataSink& sink) {
    sink.write(text.data(), text.size());
    // the header of the answer is acknowledged at once: servers without TCP_NODELAY send its body
    // only then
    const int yes = 1;
    setsockopt(http_->client.socket(), IPPROTO_TCP, TCP_QUICKACK, &yes, sizeof yes);
    return true;
  };
  return request([&] {
    return http_->client.Post(http_->path + path, httplib::Headers{}, text.size(), send_body,
                              "application/json");
  });
}

}  // namespace models
