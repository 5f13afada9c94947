// Studies for developers: limits and costs of the program, far from what a user computes.
#pragma once

#include <span>

#include "apps/program/study/study.hpp"

namespace ashlar {

[[nodiscard]] std::span<const Study> developer_studies();

}  // namespace ashlar
