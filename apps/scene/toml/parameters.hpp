// [parameters]: named numbers for the formulas of a scene.
#pragma once

#include <toml++/toml.h>

#include "apps/scene/toml/formulas.hpp"
#include "apps/scene/toml/toml_reading.hpp"

namespace ashlar {

/// Largest number of parameters of a scene.
inline constexpr std::size_t most_parameters = 10'000;

/// The values of all parameters of a document, each a finite number or a formula of others, in any order. Reports,
/// each at its place: a value that is neither, an invalid name, a formula without a number as result, circular
/// definitions, more than most_parameters. A parameter with a fault is left out, and so are, without another message,
/// those that use it.
[[nodiscard]] Formulas read_parameters(const toml::table& document, TomlReading& reading);

}  // namespace ashlar
