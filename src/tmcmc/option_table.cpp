#include "tmcmc/option_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "errors/invalid_value.hpp"
#include "names/names.hpp"

namespace tmcmc {

namespace {

template <class T>
constexpr bool is_number = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

std::string digits(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

template <class T>
std::string text_of(const T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    return value ? "yes" : "no";
  } else if constexpr (std::is_integral_v<T>) {
    return std::to_string(value);
  } else if constexpr (std::is_floating_point_v<T>) {
    return digits(value);
  } else {
    return std::string(names::name_of(value));
  }
}

/// The alternative with an index, with its defaults unless the variant already holds this
/// alternative.
template <std::size_t i = 0, class... Alternatives>
void hold(std::size_t index, std::variant<Alternatives...>& variant) {
  if constexpr (i < sizeof...(Alternatives)) {
    if (i == index && variant.index() != index) {
      variant.template emplace<i>();
    }
    hold<i + 1>(index, variant);
  }
}

/// Whether the text is a value in the range; if so, the value is set to it.
template <class T>
bool assign(std::string_view text, const OptionRange& range, T& target) {
  if constexpr (std::is_same_v<T, bool>) {
    target = text == "yes";
    return text == "yes" || text == "no";
  } else if constexpr (is_number<T>) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool admitted = error == std::errc() && end == text.data() + text.size() && range.admits(value) &&
                          (!range.whole || value == std::floor(value));
    target = admitted ? static_cast<T>(value) : target;
    return admitted;
  } else {
    const auto index = names::index_of<T>(text);
    if constexpr (names::is_variant<T>) {
      hold(index.value_or(target.index()), target);
    } else {
      target = index ? static_cast<T>(*index) : target;
    }
    return index.has_value();
  }
}

template <class T>
std::vector<std::string> values_of() {
  if constexpr (std::is_same_v<T, bool>) {
    return {"no", "yes"};
  } else if constexpr (is_number<T>) {
    return {};
  } else {
    return names::all<T>();
  }
}

std::string in_words(const OptionRange& range) {
  if (range.whole) {
    return "a whole number from " + std::to_string(static_cast<std::int64_t>(range.least)) + " to " +
           std::to_string(static_cast<std::int64_t>(range.most));
  }
  if (std::isinf(range.least) && std::isinf(range.most)) {
    return "a number or an infinity";
  }
  if (range.least > 0.0) {
    std::string words = "a positive number from " + digits(range.least) + " to " + digits(range.most);
    std::erase(words, '+');
    return words;
  }
  return std::string("a number in ") + (range.above_least ? "(" : "[") + digits(range.least) + ", " +
         digits(range.most) + (range.below_most ? ")" : "]");
}

/// Calls act(info, pointer) for the option with a given name.
template <class AnyOptions, class Act>
void with_option(AnyOptions& options, std::string_view name, Act act) {
  bool found = false;
  visit_options(options, [&](const OptionInfo& info, auto* value) {
    if (!found && info.name == name) {
      found = true;
      act(info, value);
    }
  });
  if (!found) {
    throw errors::InvalidValue("options." + std::string(name), "", "the name of an option");
  }
}

template <class T>
std::string expected_of(const OptionRange& range) {
  return is_number<T> ? in_words(range) : names::one_of(values_of<T>());
}

/// The default of an option that has a meaning only under another option.
std::string preset_under(const OptionInfo& needed, const OptionText& option) {
  Options options;
  const bool any = option.needs_value.empty();
  set_option(options, needed.name,
             any ? digits(0.5 * (needed.range.least + needed.range.most)) : std::string(option.needs_value));
  return option_value(options, option.name).value_or("");
}

}  // namespace

const std::vector<OptionText>& option_table() {
  static const std::vector<OptionText> table = [] {
    std::vector<OptionText> rows;
    const Options defaults;
    visit_options(defaults, [&rows]<class T>(const OptionInfo& info, const T* value) {
      rows.push_back(
          {info, values_of<T>(), expected_of<T>(info.range), value == nullptr ? "" : text_of(*value)});
    });
    for (OptionText& row : rows) {
      if (row.preset.empty()) {
        const auto needed = std::find_if(rows.begin(), rows.end(), [&row](const OptionText& other) {
          return other.name == row.needs_option;
        });
        row.preset = preset_under(*needed, row);
      }
    }
    return rows;
  }();
  return table;
}

std::optional<std::string> option_value(const Options& options, std::string_view name) {
  std::optional<std::string> text;
  with_option(options, name, [&text]<class T>(const OptionInfo&, const T* value) {
    if (value != nullptr) {
      text = text_of(*value);
    }
  });
  return text;
}

std::vector<std::pair<std::string, std::string>> sample_settings(const Options& options) {
  std::vector<std::pair<std::string, std::string>> all;
  for (const auto& option : option_table()) {
    const auto value = option_value(options, option.name);
    if (option.changes_samples && value) {
      all.emplace_back(option.name, *value);
    }
  }
  return all;
}

std::optional<std::string> normalised_option(std::string_view name, std::string_view value) {
  std::optional<std::string> text;
  Options scratch;
  with_option(scratch, name, [&]<class T>(const OptionInfo& info, T*) {
    T parsed{};
    if (assign(value, info.range, parsed)) {
      text = text_of(parsed);
    }
  });
  return text;
}

void set_option(Options& options, std::string_view name, std::string_view value) {
  with_option(options, name, [&]<class T>(const OptionInfo& info, T* target) {
    const std::string field = "options." + std::string(name);
    if (target == nullptr) {
      throw errors::InvalidValue(field, std::string(value),
                                 "only with " + std::string(info.needs_option) +
                                     (info.needs_value.empty() ? "" : " = " + std::string(info.needs_value)));
    }
    if (!assign(value, info.range, *target)) {
      throw errors::InvalidValue(field, std::string(value), expected_of<T>(info.range));
    }
  });
}

}  // namespace tmcmc
