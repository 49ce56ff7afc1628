/// \file
/// Requests to a server that uses JSON over HTTP, as in the UM-Bridge protocol.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace models {

/// Where the server is, and how long to wait for it.
struct ServerOptions {
  /// http://HOST[:PORT][/PATH].
  std::string url;
  /// Wait for the first byte of an answer; 0: no limit.
  double timeout_seconds = 0.0;
  /// Repetitions of a request whose connection was lost.
  int retries = 5;
};

/// Connection to the server, for one thread at a time. The TCP connection is kept for the next
/// request: servers with a short queue of new connections (cpp-httplib's has five places) let some
/// of them wait for a second. After 0.1 s without a request the connection is closed, since a
/// server may use one thread per connection.
///
/// A request is repeated, after 0.1 s and then after twice the previous wait each time, if the
/// connection cannot be made or is lost before the answer arrives, and if a load balancer without a
/// server answers with status 502, 503 or 504. The answer of a model is final, even if it is an
/// error.
class JsonConnection {
 public:
  /// \throws errors::InvalidValue for a URL of another form, a time-out that is negative or not
  ///         finite, or retries < 0.
  explicit JsonConnection(const ServerOptions& options);
  ~JsonConnection();
  JsonConnection(const JsonConnection&) = delete;
  JsonConnection& operator=(const JsonConnection&) = delete;

  /// The JSON object that the server returns for GET `path`.
  [[nodiscard]] nlohmann::json get(const std::string& path);
  /// The JSON object that the server returns for POST `path` with a JSON body.
  /// \throws ModelError for a failed model, whose body {"error": {"type": ..., "message": ...}} is
  ///         put into words, for a status other than 200, for an answer that is not a JSON object,
  ///         for an answer that takes too long, and when the retries are used up; io::Interrupted
  ///         if a signal has been received. No message names the server.
  [[nodiscard]] nlohmann::json post(const std::string& path, const nlohmann::json& body);

  /// Number of requests repeated so far.
  [[nodiscard]] long repeated() const { return repeated_; }

 private:
  struct Http;
  template <class Send>
  nlohmann::json request(const Send& send);

  ServerOptions options_;
  std::unique_ptr<Http> http_;
  long repeated_ = 0;
};

}  // namespace models
