// Goodman and Bray's columns: 16 on a stepped base that dips 30 degrees.
#pragma once

#include "apps/program/verify/verification_contacts.hpp"

namespace ashlar {

/// Columns of 25 kN/m^3. In the frame of the base, column n = 1 to 16 from the toe stands on [10 (n-1), 10 n], each
/// step 1 m higher. Heights increase by 4 m up to the tenth column and decrease by 6.2 m beyond.
void add_toppling_columns(ContactScene& scene);

}  // namespace ashlar
