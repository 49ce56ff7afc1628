/// \file
/// Requests to a server that speaks JSON over HTTP, as the UM-Bridge protocol does.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace models {

/// Where the server is, and how long to wait for it.
struct ServerOptions {
  std::string url;               ///< http://HOST[:PORT][/PATH]
  double timeout_seconds = 0.0;  ///< until the first byte of an answer; 0: no limit
  int retries = 5;               ///< of a request whose connection was lost
};

/// The way to the server, for one thread at a time. Its TCP connection is kept for the next request: servers with a short queue of
/// new connections (cpp-httplib's has five places) let some of them wait for a second. After 0.1 s without a request it is closed,
/// since a server may have a thread for each connection.
///
/// A request is repeated, after 0.1 s and then twice as long each time, if the connection cannot be made or is lost before the
/// answer, and at the status 502, 503 or 504 of a load balancer without a server. The answer of a model is final, its error too.
class JsonConnection {
 public:
  /// \throws errors::InvalidValue for another form of URL, a time-out that is negative or not finite, or retries < 0.
  explicit JsonConnection(const ServerOptions& options);
  ~JsonConnection();
  JsonConnection(const JsonConnection&) = delete;
  JsonConnection& operator=(const JsonConnection&) = delete;

  /// The JSON object with which the server answers GET `path`.
  [[nodiscard]] nlohmann::json get(const std::string& path);
  /// The same for POST of a JSON body.
  /// \throws ModelError with the body {"error": {"type": ..., "message": ...}} of a failed model in words, for another status than
  ///         200, for an answer that is no JSON object, for one that takes too long, and when the retries are used up;
  ///         io::Interrupted if a signal has come. No message names the server.
  [[nodiscard]] nlohmann::json post(const std::string& path, const nlohmann::json& body);

  /// Requests repeated so far.
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
