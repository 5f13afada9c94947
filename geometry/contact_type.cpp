#include "geometry/contact_type.hpp"

#include <algorithm>
#include <stdexcept>

namespace ashlar {

ContactType contact_type(int a_dim, int b_dim) {
  switch (10 * std::min(a_dim, b_dim) + std::max(a_dim, b_dim)) {
    case 0:
      return ContactType::vertex_vertex;
    case 1:
      return ContactType::vertex_edge;
    case 2:
      return ContactType::vertex_face;
    case 11:
      return ContactType::edge_edge;
    case 12:
      return ContactType::edge_face;
    case 22:
      return ContactType::face_face;
    default:
      throw std::logic_error("contact_type: dimension outside 0..2");
  }
}

PairKind pair_kind(int a_dim, int b_dim) {
  switch (10 * a_dim + b_dim) {
    case 0:
      return PairKind::vertex_vertex;
    case 1:
      return PairKind::vertex_edge;
    case 10:
      return PairKind::edge_vertex;
    case 11:
      return PairKind::edge_edge;
    case 2:
      return PairKind::vertex_face;
    case 20:
      return PairKind::face_vertex;
    case 12:
      return PairKind::edge_face;
    case 21:
      return PairKind::face_edge;
    case 3:
      return PairKind::vertex_solid;
    case 30:
      return PairKind::solid_vertex;
    default:
      throw std::logic_error("pair_kind: no region vertex has this pair");
  }
}

std::string_view to_string(Relation relation) {
  switch (relation) {
    case Relation::apart:
      return "apart";
    case Relation::touching:
      return "touching";
    case Relation::crossing:
      return "crossing";
  }
  return "";
}

std::string_view to_string(ContactType type) {
  switch (type) {
    case ContactType::vertex_vertex:
      return "V-V";
    case ContactType::vertex_edge:
      return "V-E";
    case ContactType::vertex_face:
      return "V-F";
    case ContactType::edge_edge:
      return "E-E";
    case ContactType::edge_face:
      return "E-F";
    case ContactType::face_face:
      return "F-F";
    case ContactType::crossing:
      return "crossing";
  }
  return "";
}

std::string_view to_string(PairKind kind) {
  switch (kind) {
    case PairKind::vertex_vertex:
      return "V-V";
    case PairKind::vertex_edge:
      return "V-E";
    case PairKind::edge_vertex:
      return "E-V";
    case PairKind::edge_edge:
      return "E-E";
    case PairKind::vertex_face:
      return "V-F";
    case PairKind::face_vertex:
      return "F-V";
    case PairKind::edge_face:
      return "E-F";
    case PairKind::face_edge:
      return "F-E";
    case PairKind::vertex_solid:
      return "V-S";
    case PairKind::solid_vertex:
      return "S-V";
  }
  return "";
}

}  // namespace ashlar
