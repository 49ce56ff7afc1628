// Random streams: known answers, independence of streams, and the distributions of the transforms.

#include <Random123/philox.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <functional>
#include <set>
#include <vector>

#include "tmcmc/detail/random_rows.hpp"
#include "tmcmc/random.hpp"
#include "tmcmc/statistics.hpp"

namespace {

using Catch::Matchers::WithinAbs;
using statistics::kolmogorov;
using statistics::kolmogorov_bound;
using statistics::standard_errors;
using tmcmc::DrawId;
using tmcmc::Purpose;
using tmcmc::random_words;
using tmcmc::StreamKey;
using tmcmc::Words;

constexpr std::size_t draws = 200000;

/// A place in some stream, and where it lies relative to another.
struct Place {
  StreamKey key{.seed = 42, .study = 1, .arm = 2, .run = 3};
  DrawId id{.purpose = Purpose::move, .stage = 4, .row = 5, .draw = 1, .attempt = 0, .block = 0};
};

/// One uniform and two normals a row, from the words as the sampler uses them.
double uniform_at(const Place& place, std::size_t row) {
  DrawId id = place.id;
  id.row = row;
  return tmcmc::uniform_open(random_words(place.key, id)[0]);
}

std::vector<double> normals(const Place& place, std::size_t n) {
  std::vector<double> result;
  DrawId id = place.id;
  for (id.row = 0; 4 * id.row < n; ++id.row) {
    const Words w = random_words(place.key, id);
    const auto a = tmcmc::normal_pair(w[1], w[3] >> 32U);
    const auto b = tmcmc::normal_pair(w[2], w[3]);
    result.insert(result.end(), {a.first, a.second, b.first, b.second});
  }
  return result;
}

double mean_power(const std::vector<double>& values, int power) {
  double sum = 0.0;
  for (const double value : values) {
    sum += std::pow(value, power);
  }
  return sum / static_cast<double>(values.size());
}

}  // namespace

TEST_CASE("the words are Philox 4x64-10: known answer for counter and key of zeros", "[tmcmc][random]") {
  CHECK(random_words({}, {}) ==
        Words{0x16554d9eca36314cU, 0xdb20fe9d672d0fdcU, 0xd7e772cee186176bU, 0x7e68b68aec7ba23bU});
}

TEST_CASE("counter and key are laid out as the header states", "[tmcmc][random]") {
  const StreamKey key{
      .seed = 0x0123456789abcdefU, .study = 0x89abcdefU, .arm = 0xabcdefU, .run = 0xfedcba98U};
  const DrawId id{.purpose = Purpose::data,
                  .stage = 0x76543210U,
                  .row = 0xfedcba9876543210U,
                  .draw = 0x13579bdfU,
                  .attempt = 0xfdb97531U,
                  .block = 0x2468aceU};
  const auto words =
      r123::Philox4x64()({{0x03abcdef76543210U, 0xfedcba9876543210U, 0xfdb9753113579bdfU, 0x02468aceU}},
                         {{0x0123456789abcdefU, 0x89abcdeffedcba98U}});
  CHECK(random_words(key, id) == Words{words[0], words[1], words[2], words[3]});
}

TEST_CASE("the words of several rows are those of each row alone", "[tmcmc][random]") {
  const StreamKey key{.seed = 5, .study = 2, .arm = 1, .run = 9};
  DrawId id{.purpose = Purpose::move, .stage = 3, .row = 77, .draw = 4, .attempt = 1, .block = 6};
  const std::vector<std::uint64_t> rows{0, 1, 64, 63, std::uint64_t{1} << 40U, 1};
  constexpr std::size_t stride = 8;
  std::vector<std::uint64_t> words(4 * stride, 0);
  tmcmc::detail::random_words_of_rows(key, id, rows, words);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    id.row = rows[i];
    CHECK(random_words(key, id) ==
          Words{words[i], words[stride + i], words[2 * stride + i], words[3 * stride + i]});
  }
  CHECK(words[rows.size()] == 0);
}

TEST_CASE("streams that differ in one bit of one field, or in two, differ in every word", "[tmcmc][random]") {
  using Change = std::function<void(Place&)>;
  std::vector<Change> changes;
  for (unsigned bit = 0; bit < 64; ++bit) {
    changes.emplace_back([bit](Place& p) { p.key.seed ^= std::uint64_t{1} << bit; });
    changes.emplace_back([bit](Place& p) { p.id.row ^= std::uint64_t{1} << bit; });
  }
  for (unsigned bit = 0; bit < 32; ++bit) {
    const std::uint32_t flip = std::uint32_t{1} << bit;
    changes.emplace_back([flip](Place& p) { p.key.study ^= flip; });
    changes.emplace_back([flip](Place& p) { p.key.run ^= flip; });
    changes.emplace_back([flip](Place& p) { p.id.stage ^= flip; });
    changes.emplace_back([flip](Place& p) { p.id.draw ^= flip; });
    changes.emplace_back([flip](Place& p) { p.id.attempt ^= flip; });
    changes.emplace_back([flip](Place& p) { p.id.block ^= flip; });
  }
  for (unsigned bit = 0; bit < 24; ++bit) {  // arms are below 2^24
    changes.emplace_back([bit](Place& p) { p.key.arm ^= std::uint32_t{1} << bit; });
  }
  for (const Purpose purpose : {Purpose::prior, Purpose::resampling, Purpose::data}) {
    changes.emplace_back([purpose](Place& p) { p.id.purpose = purpose; });
  }
  changes.emplace_back([](Place&) {});

  // All pairs of changes: two fields that shared bits of the counter would cancel or coincide.
  // Equal pairs in either order name the same place, as do two purposes (the later one holds).
  std::vector<std::set<std::uint64_t>> seen(4);
  std::size_t places = 0;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    for (std::size_t j = i + 1; j < changes.size(); ++j) {
      const bool both_purposes = i + 4 >= changes.size() && j + 1 < changes.size();
      if (both_purposes) {
        continue;
      }
      Place place;
      changes[i](place);
      changes[j](place);
      const Words words = random_words(place.key, place.id);
      for (std::size_t k = 0; k < 4; ++k) {
        seen[k].insert(words[k]);
      }
      ++places;
    }
  }
  for (const auto& words : seen) {
    CHECK(words.size() == places);
  }
}

TEST_CASE("uniforms lie inside the open interval, symmetrically", "[tmcmc][random]") {
  CHECK(tmcmc::uniform_open(0) == 0x1p-53);
  CHECK(tmcmc::uniform_open(~std::uint64_t{0}) == 1.0 - 0x1p-53);
  CHECK(tmcmc::uniform_open(std::uint64_t{1} << 63U) == 0.5 + 0x1p-53);
  CHECK(tmcmc::uniform_open(0xfffU) == tmcmc::uniform_open(0));  // the lower 12 bits are not used
  CHECK(tmcmc::uniform_32(0) == 0.0);
  CHECK(tmcmc::uniform_32(0xffffffffU) == 1.0 - 0x1p-32);
  CHECK(tmcmc::uniform_32(0xdeadbeef00000001U) == 0x1p-32);
}

TEST_CASE("uniforms are uniform", "[tmcmc][random]") {
  const Place place;
  std::vector<double> u(draws);
  for (std::size_t i = 0; i < draws; ++i) {
    u[i] = uniform_at(place, i);
  }
  CHECK(kolmogorov(u, [](double x) { return x; }) < kolmogorov_bound);
  const double n = static_cast<double>(draws);
  CHECK_THAT(mean_power(u, 1), WithinAbs(1.0 / 2.0, standard_errors * std::sqrt(1.0 / 12.0 / n)));
  CHECK_THAT(mean_power(u, 2), WithinAbs(1.0 / 3.0, standard_errors * std::sqrt(4.0 / 45.0 / n)));
}

TEST_CASE("normals have the moments, tails and distribution of a standard normal", "[tmcmc][random]") {
  const auto z = normals({}, draws);
  const double n = static_cast<double>(z.size());
  // Variances of z^k: 1, 2, 15, 96.
  CHECK_THAT(mean_power(z, 1), WithinAbs(0.0, standard_errors * std::sqrt(1.0 / n)));
  CHECK_THAT(mean_power(z, 2), WithinAbs(1.0, standard_errors * std::sqrt(2.0 / n)));
  CHECK_THAT(mean_power(z, 3), WithinAbs(0.0, standard_errors * std::sqrt(15.0 / n)));
  CHECK_THAT(mean_power(z, 4), WithinAbs(3.0, standard_errors * std::sqrt(96.0 / n)));
  CHECK(kolmogorov(z, statistics::normal_cdf) < kolmogorov_bound);
  for (const double level : {1.0, 2.0, 3.0, 3.5}) {
    CAPTURE(level);
    const double p = statistics::normal_cdf(-level);
    const double bound = standard_errors * std::sqrt(p * (1.0 - p) * n);
    const auto above = std::count_if(z.begin(), z.end(), [=](double x) { return x > level; });
    const auto below = std::count_if(z.begin(), z.end(), [=](double x) { return x < -level; });
    CHECK_THAT(static_cast<double>(above), WithinAbs(p * n, bound));
    CHECK_THAT(static_cast<double>(below), WithinAbs(p * n, bound));
  }
}

TEST_CASE("the four normals of a block are uncorrelated, and so are their squares", "[tmcmc][random]") {
  const auto z = normals({}, draws);
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = a + 1; b < 4; ++b) {
      CAPTURE(a, b);
      std::vector<double> x;
      std::vector<double> y;
      std::vector<double> x_squared;
      std::vector<double> y_squared;
      for (std::size_t i = 0; i < z.size(); i += 4) {
        x.push_back(z[i + a]);
        y.push_back(z[i + b]);
        x_squared.push_back(z[i + a] * z[i + a]);
        y_squared.push_back(z[i + b] * z[i + b]);
      }
      CHECK(std::fabs(statistics::scaled_correlation(x, y)) < standard_errors);
      CHECK(std::fabs(statistics::scaled_correlation(x_squared, y_squared)) < standard_errors);
    }
  }
}

TEST_CASE("the extreme words give finite normals", "[tmcmc][random]") {
  const double largest = std::sqrt(106.0 * std::log(2.0));  // of the uniform 2^-53
  for (const std::uint64_t angle :
       {std::uint64_t{0}, std::uint64_t{0x40000000U}, std::uint64_t{0xffffffffU}}) {
    const auto far = tmcmc::normal_pair(0, angle);
    CHECK_THAT(std::hypot(far.first, far.second), WithinAbs(largest, 1e-14));
    const auto near = tmcmc::normal_pair(~std::uint64_t{0}, angle);
    CHECK(std::hypot(near.first, near.second) < 1.5e-8);
  }
  CHECK(tmcmc::normal_pair(0, 0).second == 0.0);
  CHECK(tmcmc::normal_pair(0, 0x80000000U).first < 0.0);
}

TEST_CASE("neighbouring places are uncorrelated", "[tmcmc][random]") {
  const Place place;
  std::vector<double> here(draws / 2);
  for (std::size_t i = 0; i < here.size(); ++i) {
    here[i] = uniform_at(place, i);
  }
  const auto correlation = [&](const Place& other, std::size_t row_offset) {
    std::vector<double> there(here.size());
    for (std::size_t i = 0; i < there.size(); ++i) {
      there[i] = uniform_at(other, i + row_offset);
    }
    return std::fabs(statistics::scaled_correlation(here, there));
  };
  CHECK(correlation(place, 1) < standard_errors);
  Place next = place;
  ++next.id.stage;
  CHECK(correlation(next, 0) < standard_errors);
  next = place;
  ++next.id.draw;
  CHECK(correlation(next, 0) < standard_errors);
  next = place;
  ++next.id.attempt;
  CHECK(correlation(next, 0) < standard_errors);
  next = place;
  next.id.purpose = Purpose::prior;
  CHECK(correlation(next, 0) < standard_errors);
  next = place;
  ++next.key.run;
  CHECK(correlation(next, 0) < standard_errors);
  next = place;
  ++next.key.seed;
  CHECK(correlation(next, 0) < standard_errors);
}
