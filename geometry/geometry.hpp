// The public interface of this layer: solids from files and shapes, the exact contact of two, and the surfaces and
// searches needed by a simulation. Headers not included from here are internal and not installed.
#pragma once

#include "geometry/any_solid/closest_point.hpp"
#include "geometry/any_solid/solid_depth.hpp"
#include "geometry/boxes/box_pairs.hpp"
#include "geometry/contact_type.hpp"
#include "geometry/contacts/contact_report.hpp"
#include "geometry/contacts/contact_search.hpp"
#include "geometry/contacts/convex_search.hpp"
#include "geometry/contacts/motion_check.hpp"
#include "geometry/convex/convex_contact.hpp"
#include "geometry/cutting/cut_solid.hpp"
#include "geometry/library_versions.hpp"
#include "geometry/mesh/mesh_io.hpp"
#include "geometry/mesh/volume_mesh.hpp"
#include "geometry/solid/hull_solid.hpp"
#include "geometry/solid/polyhedron.hpp"
#include "geometry/solid/shapes.hpp"
#include "geometry/solid/solid_location.hpp"
#include "geometry/subfaces/placed_surface.hpp"
#include "geometry/subfaces/sub_face_refinement.hpp"
