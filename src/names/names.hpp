/// \file
/// Names of enumerators and of the alternatives of a variant, for command lines, files and reports.
///
/// An enum defines its names next to it, in the order of its values, which count from 0:
///
///     enum class Deviation { population, sample };
///     constexpr std::array<std::string_view, 2> enumerator_names(std::type_identity<Deviation>) {
///       return {"population", "sample"};
///     }
///
/// An alternative of a variant has a static member `name`.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace names {

/// Whether T is a std::variant.
template <class T>
inline constexpr bool is_variant = false;
template <class... Alternatives>
inline constexpr bool is_variant<std::variant<Alternatives...>> = true;

/// Names of all alternatives.
template <class... Alternatives>
constexpr std::array<std::string_view, sizeof...(Alternatives)> enumerator_names(
    std::type_identity<std::variant<Alternatives...>>) {
  return {Alternatives::name...};
}

/// All names of an enum or a variant, in the order of its values.
template <class T>
[[nodiscard]] std::vector<std::string> all() {
  const auto list = enumerator_names(std::type_identity<T>());
  return {list.begin(), list.end()};
}

/// Name of an enumerator, or of the alternative that a variant holds.
template <class T>
[[nodiscard]] std::string_view name_of(const T& value) {
  const auto list = enumerator_names(std::type_identity<T>());
  if constexpr (is_variant<T>) {
    return list.at(value.index());
  } else {
    return list.at(static_cast<std::size_t>(value));
  }
}

/// Position of a name among the names of an enum or a variant; nothing if there is no such name.
template <class T>
[[nodiscard]] std::optional<std::size_t> index_of(std::string_view name) {
  const auto list = enumerator_names(std::type_identity<T>());
  const auto found = std::find(list.begin(), list.end(), name);
  return found == list.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - list.begin()));
}

/// The enumerator with a name; nothing if there is no such name.
template <class Enum>
[[nodiscard]] std::optional<Enum> value_of(std::string_view name) {
  const auto index = index_of<Enum>(name);
  return index ? std::optional(static_cast<Enum>(*index)) : std::nullopt;
}

/// "a, b or c", to say what was expected.
[[nodiscard]] inline std::string one_of(const std::vector<std::string>& list) {
  std::string words;
  for (std::size_t i = 0; i < list.size(); ++i) {
    words += i == 0 ? "" : i + 1 == list.size() ? " or " : ", ";
    words += list[i];
  }
  return words;
}

}  // namespace names
