#include "solver/ranks/ranks.hpp"

#include <algorithm>
#include <cstring>

namespace ashlar {
namespace {

Bytes bytes_of(const std::vector<double>& values) {
  Bytes bytes(values.size() * sizeof(double));
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

std::vector<double> doubles_of(const Bytes& bytes) {
  std::vector<double> values(bytes.size() / sizeof(double));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

}  // namespace

std::vector<double> sum_of_ranks(Ranks& ranks, const std::vector<double>& values) {
  std::vector<double> sum(values.size(), 0.0);
  for (const Bytes& given : ranks.gather(bytes_of(values))) {
    const std::vector<double> part = doubles_of(given);
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += part[k];
  }
  return sum;
}

double sum_of_ranks(Ranks& ranks, double value) {
  return sum_of_ranks(ranks, std::vector{value})[0];
}

double max_of_ranks(Ranks& ranks, double value) {
  for (const Bytes& given : ranks.gather(bytes_of({value}))) value = std::max(value, doubles_of(given)[0]);
  return value;
}

bool any_rank(Ranks& ranks, bool value) {
  return max_of_ranks(ranks, value ? 1.0 : 0.0) > 0.0;
}

}  // namespace ashlar
