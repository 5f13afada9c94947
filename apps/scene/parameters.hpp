// [parameters]: the named numbers that formulas of a scene use.
#pragma once

#include <toml++/toml.h>

#include "apps/scene/formulas.hpp"
#include "apps/scene/toml_reading.hpp"

namespace ashlar {

/// Parameters that a scene may have.
inline constexpr std::size_t most_parameters = 10'000;

/// The values of all parameters of a document, each a finite number or a formula of others, in any order.
/// Reported, each at its place: a value that is neither, a name that formulas cannot have, a formula that
/// gives no number, parameters that need each other in a circle, more than most_parameters. A parameter with
/// a fault is left out, and so, without a word, are those that use it.
[[nodiscard]] Formulas read_parameters(const toml::table& document, TomlReading& reading);

}  // namespace ashlar
