#include "solver/ranks/row_numbering.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <unordered_map>

#include "geometry/index.hpp"
#include "solver/ranks/rank_values.hpp"

namespace ashlar {
namespace {

struct PublishedBody {
  std::int64_t first;
  int body;
  int size;
};

struct RowSums {
  std::int64_t unknowns;
  int least;
  int most;
};

/// @param lists by receiver. @return by sender
template <class Value>
std::vector<std::vector<Value>> exchange_lists(Ranks& ranks, const std::vector<std::vector<Value>>& lists) {
  std::vector<Bytes> messages;
  messages.reserve(lists.size());
  for (const std::vector<Value>& list : lists) messages.push_back(bytes_of_values<Value>(list));
  std::vector<std::vector<Value>> received;
  for (const Bytes& message : ranks.exchange(std::move(messages)))
    received.push_back(values_of_bytes<Value>(message));
  return received;
}

int home_of(int body, const Ranks& ranks) {
  return body % ranks.count();
}

/// Fills all but the places asked for.
RowNumbering counted(Ranks& ranks, const std::vector<int>& sizes) {
  RowNumbering result;
  RowSums own{std::accumulate(sizes.begin(), sizes.end(), std::int64_t{0}), 0, 0};
  if (!sizes.empty()) {
    own.least = *std::min_element(sizes.begin(), sizes.end());
    own.most = *std::max_element(sizes.begin(), sizes.end());
  }
  const std::vector<Bytes> all = ranks.gather(bytes_of_values<RowSums>({&own, 1}));
  bool differ = false;
  for (std::size_t rank = 0; rank < all.size(); ++rank) {
    const RowSums sums = values_of_bytes<RowSums>(all[rank])[0];
    if (rank == at(ranks.own())) result.first_own = result.all;
    result.all += sums.unknowns;
    if (sums.unknowns == 0) continue;
    if (result.common_size == 0) result.common_size = sums.least;
    differ |= sums.least != sums.most || sums.least != result.common_size;
  }
  result.own = own.unknowns;
  if (differ) result.common_size = 0;
  return result;
}

/// The bodies whose home is this rank.
std::unordered_map<int, BodyPlace> bodies_at_home(Ranks& ranks, const std::vector<int>& bodies,
                                                  const std::vector<int>& sizes, std::int64_t first) {
  std::vector<std::vector<PublishedBody>> published(at(ranks.count()));
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    published[at(home_of(bodies[k], ranks))].push_back({first, bodies[k], sizes[k]});
    first += sizes[k];
  }
  std::unordered_map<int, BodyPlace> places;
  for (const std::vector<PublishedBody>& message : exchange_lists(ranks, published))
    for (const PublishedBody& body : message) places[body.body] = {body.first, body.size};
  return places;
}

}  // namespace

RowNumbering number_rows(Ranks& ranks, const std::vector<int>& bodies, const std::vector<int>& sizes,
                         const std::vector<int>& asked) {
  RowNumbering result = counted(ranks, sizes);
  const auto places = bodies_at_home(ranks, bodies, sizes, result.first_own);
  std::vector<std::vector<int>> questions(at(ranks.count()));
  for (const int body : asked) questions[at(home_of(body, ranks))].push_back(body);
  std::vector<std::vector<BodyPlace>> answers(at(ranks.count()));
  const auto heard = exchange_lists(ranks, questions);
  for (std::size_t rank = 0; rank < heard.size(); ++rank) {
    for (const int body : heard[rank]) {
      const auto found = places.find(body);
      answers[rank].push_back(found == places.end() ? BodyPlace{} : found->second);
    }
  }
  const auto told = exchange_lists(ranks, answers);
  std::vector<std::size_t> next(told.size(), 0);
  for (const int body : asked) {
    const std::size_t home = at(home_of(body, ranks));
    result.asked.push_back(told[home][next[home]++]);
    if (result.asked.back().first < 0)
      throw std::invalid_argument("no rank has the rows of body " + std::to_string(body));
  }
  return result;
}

}  // namespace ashlar
