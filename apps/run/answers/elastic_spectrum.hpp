// Elastic response spectra of acceleration at the ground, of codes or as points (scene_pushover.hpp).
//
// EN 1998-1:2004, 3.2.2.2, (3.2) to (3.6), with S, TB, TC, TD of tables 3.2 and 3.3 and eta = sqrt(10 / (5 + xi)) >= 0.55:
//   T <= TB        ag S (1 + T / TB (2.5 eta - 1))
//   TB to TC       2.5 ag S eta
//   TC to TD       2.5 ag S eta TC / T
//   beyond TD      2.5 ag S eta TC TD / T^2
// NTC 2018 (D.M. 17 January 2018), 3.2.3.2.1, with F0 in place of 2.5, S = SS ST, TC = CC TC*, TB = TC / 3 and
// TD = 4 ag / g + 1.6 s; SS and CC of table 3.2.IV.
#pragma once

#include "apps/scene/model/scene_pushover.hpp"

namespace ashlar {

/// m/s^2. @param spectrum with a source. @param period s, >= 0
[[nodiscard]] double spectral_acceleration(const SceneSpectrum& spectrum, double period);

/// m: acceleration times (T / (2 pi))^2.
[[nodiscard]] double spectral_displacement(const SceneSpectrum& spectrum, double period);

}  // namespace ashlar
