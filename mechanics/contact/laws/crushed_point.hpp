// The normal force of a contact point whose pressure has a plastic cap (joint_law.hpp): f the compressive strength, P = f A.
//
// Compression beyond P/kn is closure c, which remains: the rest gap of the spring falls by it. The spring holds P^2/(2 kn)
// then, and P c is dissipated. Material between the blocks is crushed: they overlap by the closure.
#pragma once

#include "mechanics/contact/laws/joint_law.hpp"

namespace ashlar {

/// Sets the mean normal force over a step, and its tangent. The force is linear between the gaps where it has kinks, so
/// that its mean is that of trapezoids: its work is exactly the change of the spring's energy and P c.
/// @param start,end gaps over the rest gap less the closure at the start of the step, m
void set_mean_crushing(const PointLaw& law, double start, double end, MeanResponse& mean);

}  // namespace ashlar
