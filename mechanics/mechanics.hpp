// The public interface of this layer: blocks as polynomials over solids, their supports and loads, and the contact
// points and joint law between two blocks. Headers not included from here are internal and not installed.
#pragma once

#include "geometry/geometry.hpp"
#include "mechanics/basis/moments.hpp"
#include "mechanics/basis/monomial_basis.hpp"
#include "mechanics/basis/quadrature.hpp"
#include "mechanics/block/block_model.hpp"
#include "mechanics/block/block_surface.hpp"
#include "mechanics/block/material_map.hpp"
#include "mechanics/block/order_change.hpp"
#include "mechanics/block/rigid_motions.hpp"
#include "mechanics/contact/contact_points.hpp"
#include "mechanics/contact/laws/joint_law.hpp"
#include "mechanics/contact/laws/tie.hpp"
#include "mechanics/material/poisson_limit.hpp"
#include "mechanics/supports/face_selection.hpp"
#include "mechanics/supports/quiet_faces.hpp"
#include "mechanics/supports/support_motion.hpp"
