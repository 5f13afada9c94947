// The classifier of geometry/ held against the oracle, and against itself on variants. Differences are
// returned as words, so that a test can list many pairs and a program can count them.
#pragma once

#include <string>
#include <vector>

#include "geometry/convex/convex_contact.hpp"
#include "oracle/exact_oracle.hpp"
#include "oracle/variants.hpp"

namespace ashlar::oracle {

using Differences = std::vector<std::string>;

[[nodiscard]] ConvexShape to_convex_shape(const Shape& shape);

/// Every field of the classifier's report that is not the correctly rounded exact answer.
[[nodiscard]] Differences compare_with_oracle(const Shape& p, const Shape& q);

/// Every field of a variant's report that is not the pair's own, carried along. Places are compared where no
/// offset changes their rounding, normals where the pair fixes them.
[[nodiscard]] Differences compare_with_variant(const ConvexContact& original, const ConvexContact& of_variant,
                                               const Variant& variant, bool triangles);

/// Coordinates in hexadecimal, as the corpus writes them.
[[nodiscard]] std::string to_json(const Shape& p, const Shape& q);

}  // namespace ashlar::oracle
