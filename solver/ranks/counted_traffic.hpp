// Traffic of a part of a run.
#pragma once

#include "solver/ranks/ranks.hpp"

namespace ashlar {

/// Adds the traffic of a rank while this exists to a sum.
class CountedTraffic {
 public:
  /// @param ranks,sum must outlive this
  CountedTraffic(const Ranks& ranks, RankTraffic& sum) : ranks_(ranks), sum_(sum), before_(ranks.traffic()) {}
  ~CountedTraffic() { sum_ += ranks_.traffic().since(before_); }
  CountedTraffic(const CountedTraffic&) = delete;
  CountedTraffic& operator=(const CountedTraffic&) = delete;

 private:
  const Ranks& ranks_;
  RankTraffic& sum_;
  RankTraffic before_;
};

}  // namespace ashlar
