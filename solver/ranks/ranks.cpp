#include "solver/ranks/ranks.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "solver/ranks/rank_values.hpp"

namespace ashlar {
std::vector<double> sum_of_ranks(Ranks& ranks, const std::vector<double>& values) {
  std::vector<double> sum(values.size(), 0.0);
  for (const Bytes& given : ranks.gather(bytes_of_values<double>(values))) {
    const std::vector<double> part = values_of_bytes<double>(given);
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += part[k];
  }
  return sum;
}

double sum_of_ranks(Ranks& ranks, double value) {
  return sum_of_ranks(ranks, std::vector{value})[0];
}

std::vector<double> max_of_ranks(Ranks& ranks, const std::vector<double>& values) {
  std::vector<double> most(values.size(), -std::numeric_limits<double>::infinity());
  for (const Bytes& given : ranks.gather(bytes_of_values<double>(values))) {
    const std::vector<double> part = values_of_bytes<double>(given);
    for (std::size_t k = 0; k < most.size(); ++k)
      most[k] = std::isnan(part[k]) ? std::numeric_limits<double>::infinity() : std::max(most[k], part[k]);
  }
  return most;
}

double max_of_ranks(Ranks& ranks, double value) {
  return max_of_ranks(ranks, std::vector{value})[0];
}

double min_of_ranks(Ranks& ranks, double value) {
  return -max_of_ranks(ranks, -value);
}

bool any_rank(Ranks& ranks, bool value) {
  return max_of_ranks(ranks, value ? 1.0 : 0.0) > 0.0;
}

void do_on_all(Ranks& ranks, const std::function<void()>& work) {
  // The first byte says how it ended, the others are the text of the exception.
  enum : unsigned char { done, invalid, failed };
  std::exception_ptr thrown;
  Bytes outcome = {std::byte{done}};
  const auto note = [&](unsigned char how, std::string_view text) {
    thrown = std::current_exception();
    outcome[0] = std::byte{how};
    const auto bytes = std::as_bytes(std::span<const char>(text));
    outcome.insert(outcome.end(), bytes.begin(), bytes.end());
  };
  try {
    work();
  } catch (const std::invalid_argument& error) {
    note(invalid, error.what());
  } catch (const std::exception& error) {
    note(failed, error.what());
  } catch (...) {
    note(failed, "unknown error");
  }
  const std::vector<Bytes> outcomes = ranks.gather(outcome);
  if (thrown) std::rethrow_exception(thrown);
  for (const Bytes& other : outcomes) {
    if (other[0] == std::byte{done}) continue;
    const std::string text(reinterpret_cast<const char*>(other.data()) + 1, other.size() - 1);
    if (other[0] == std::byte{invalid}) throw std::invalid_argument(text);
    throw std::runtime_error(text);
  }
}

}  // namespace ashlar
