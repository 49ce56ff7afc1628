// Names of enumerators and of the alternatives of a variant.

#include <catch2/catch.hpp>

#include "names/names.hpp"

namespace elsewhere {

enum class Colour { red, dark_blue };
constexpr std::array<std::string_view, 2> enumerator_names(std::type_identity<Colour>) {
  return {"red", "dark-blue"};
}

struct Circle {
  static constexpr std::string_view name = "circle";
};
struct Square {
  static constexpr std::string_view name = "square";
};
using Shape = std::variant<Circle, Square>;

}  // namespace elsewhere

using elsewhere::Colour;
using elsewhere::Shape;

TEST_CASE("an enumerator has the name that stands beside the enum, and the other way round", "[names]") {
  CHECK(names::all<Colour>() == std::vector<std::string>{"red", "dark-blue"});
  CHECK(names::name_of(Colour::red) == "red");
  CHECK(names::name_of(Colour::dark_blue) == "dark-blue");
  CHECK(names::value_of<Colour>("red") == Colour::red);
  CHECK(names::value_of<Colour>("dark-blue") == Colour::dark_blue);
  for (const char* bad : {"", "blue", "Red", "red "}) {
    CHECK_FALSE(names::value_of<Colour>(bad).has_value());
  }
  CHECK_THROWS_AS(names::name_of(static_cast<Colour>(2)), std::out_of_range);
}

TEST_CASE("a variant has the names of its alternatives", "[names]") {
  CHECK(names::all<Shape>() == std::vector<std::string>{"circle", "square"});
  CHECK(names::name_of(Shape(elsewhere::Square{})) == "square");
  CHECK(names::index_of<Shape>("square") == 1U);
  CHECK_FALSE(names::index_of<Shape>("cube").has_value());
}

TEST_CASE("a list of names in words", "[names]") {
  CHECK(names::one_of({}).empty());
  CHECK(names::one_of({"a"}) == "a");
  CHECK(names::one_of({"a", "b"}) == "a or b");
  CHECK(names::one_of({"a", "b", "c"}) == "a, b or c");
}
