// JSON is written directly: 10,000 reports in a second leave no time for a tree of each.
#include "apps/program/contacts/contact_report_json.hpp"

#include <fmt/format.h>

#include <iterator>

#include "apps/results/text/json_text.hpp"

namespace ashlar {
namespace {

using Buffer = fmt::memory_buffer;

constexpr std::string_view feature_names[] = {"corner", "edge", "face"};

void put(Buffer& out, std::string_view text) {
  out.append(text.data(), text.data() + text.size());
}

void put(Buffer& out, double value) {
  append_json_number(out, value);
}

void put(Buffer& out, const Vector3& v) {
  put(out, "[");
  for (int i = 0; i < 3; ++i) {
    if (i > 0) put(out, ",");
    put(out, v[i]);
  }
  put(out, "]");
}

template <class Range, class Put>
void put_list(Buffer& out, const Range& range, Put put_item) {
  put(out, "[");
  bool first = true;
  for (const auto& item : range) {
    if (!first) put(out, ",");
    first = false;
    put_item(item);
  }
  put(out, "]");
}

void put_vectors(Buffer& out, const std::vector<Vector3>& vectors) {
  put_list(out, vectors, [&](const Vector3& v) { put(out, v); });
}

// Names as in contact_types.md; a corner is named by its point of the mesh.
std::string name_of(const ReportedFeature& feature) {
  if (feature.index >= 0)
    return fmt::format("{} {}", feature.dimension == 0 ? "vertex" : feature_names[feature.dimension],
                       feature.index);
  if (feature.points.empty()) return {};
  std::string name = fmt::format("hull {} ", feature_names[feature.dimension]);
  for (std::size_t k = 0; k < feature.points.size(); ++k)
    name += fmt::format("{}{}", k == 0 ? "" : "-", feature.points[k]);
  return name;
}

void put_name(Buffer& out, const ReportedFeature& feature) {
  const std::string name = name_of(feature);
  if (name.empty())
    put(out, "null");
  else
    fmt::format_to(std::back_inserter(out), "\"{}\"", name);
}

std::string_view name_of(ReportedBody body) {
  return body == ReportedBody::a ? "A" : "B";
}

std::string_view name_of(DirectionRule rule) {
  switch (rule) {
    case DirectionRule::closest_points:
      return "closest points";
    case DirectionRule::unique:
      return "unique";
    case DirectionRule::history:
      return "history";
    case DirectionRule::least_penetration:
      return "least penetration";
    case DirectionRule::least_penetration_tie:
      return "least penetration, tie";
  }
  return "";
}

void put_point(Buffer& out, const ReportedPoint& p) {
  fmt::format_to(std::back_inserter(out), "{{\"pair\":\"{}\",\"point\":", to_string(p.pair));
  put(out, p.point);
  put(out, ",\"face_of\":");
  if (p.face_of)
    fmt::format_to(std::back_inserter(out), "\"{}\"", name_of(*p.face_of));
  else
    put(out, "null");
  put(out, ",\"plane\":{\"point\":");
  put(out, p.plane_point);
  put(out, ",\"normal\":");
  put(out, p.plane_normal);
  put(out, "},\"foot\":");
  put(out, p.foot);
  put(out, ",\"gap\":");
  put(out, p.gap);
  put(out, "}");
}

// @param is_convex the report has the distance and direction of its one contact.
void put_contact(Buffer& out, const ReportedContact& contact, bool is_convex) {
  fmt::format_to(std::back_inserter(out), "{{\"type\":\"{}\",\"a\":", to_string(contact.type));
  put_name(out, contact.a);
  put(out, ",\"b\":");
  put_name(out, contact.b);
  fmt::format_to(std::back_inserter(out), ",\"region_dim\":{},\"area\":", contact.region_dimension);
  put(out, contact.area);
  if (!is_convex) {
    put(out, ",\"squared_distance\":");
    put(out, contact.squared_distance);
    put(out, ",\"direction\":");
    if (contact.direction.isZero(0.0))
      put(out, "null");
    else
      put(out, contact.direction);
  }
  put(out, ",\"points\":");
  put_list(out, contact.points, [&](const ReportedPoint& p) { put_point(out, p); });
  put(out, "}");
}

void put_convex_part(Buffer& out, const ContactReport& report) {
  if (!report.convex) {
    put(out, "\"type\":null,\"a_dim\":null,\"b_dim\":null,\"region_dim\":null,\"squared_distance\":");
    put(out, report.squared_distance);
    put(out, ",\"direction\":null,\"direction_rule\":null,\"region\":[]");
    return;
  }
  const ConvexReport& convex = *report.convex;
  fmt::format_to(std::back_inserter(out),
                 "\"type\":\"{}\",\"a_dim\":{},\"b_dim\":{},\"region_dim\":{},\"squared_distance\":",
                 to_string(convex.type), convex.a_dimension, convex.b_dimension, convex.region_dimension);
  put(out, report.squared_distance);
  put(out, ",\"direction\":");
  put(out, convex.direction);
  fmt::format_to(std::back_inserter(out), ",\"direction_rule\":\"{}\",\"region\":", name_of(convex.rule));
  put_vectors(out, convex.region);
}

std::string text_of(const Vector3& v) {
  return fmt::format("({}, {}, {})", v.x(), v.y(), v.z());
}

std::string text_of(const ReportedFeature& feature) {
  const std::string name = name_of(feature);
  return name.empty() ? fmt::format("{} of the projection", feature_names[feature.dimension]) : name;
}

void put_contact_text(Buffer& out, const ReportedContact& contact, bool is_convex) {
  fmt::format_to(std::back_inserter(out), "  {} contact: {} of A, {} of B", to_string(contact.type),
                 text_of(contact.a), text_of(contact.b));
  if (contact.region_dimension == 2) fmt::format_to(std::back_inserter(out), ", area {}", contact.area);
  if (!is_convex) {
    fmt::format_to(std::back_inserter(out), ", squared distance {}", contact.squared_distance);
    if (!contact.direction.isZero(0.0))
      fmt::format_to(std::back_inserter(out), ", direction from B to A {}", text_of(contact.direction));
  }
  put(out, "\n");
  for (const ReportedPoint& p : contact.points) {
    fmt::format_to(std::back_inserter(out), "    {} at {}, foot {}, gap {}", to_string(p.pair),
                   text_of(p.point), text_of(p.foot), p.gap);
    if (p.face_of)
      fmt::format_to(std::back_inserter(out), ", on a face of {} with normal {}", name_of(*p.face_of),
                     text_of(p.plane_normal));
    put(out, "\n");
  }
}

}  // namespace

std::string contact_report_json(const ContactReport& report, double angle) {
  Buffer out;
  fmt::format_to(std::back_inserter(out), "{{\"relation\":\"{}\",", to_string(report.relation));
  put_convex_part(out, report);
  put(out, ",\"contacts\":");
  put_list(out, report.contacts,
           [&](const ReportedContact& contact) { put_contact(out, contact, report.convex.has_value()); });
  put(out, ",\"depth\":");
  if (report.convex || report.relation != Relation::crossing)
    put(out, report.depth);
  else
    put(out, "null");
  put(out, ",\"minimal_translations\":");
  put_vectors(out, report.minimal_translations);
  if (report.hull_of_a || report.hull_of_b) {
    put(out, ",\"hull_of\":");
    put(out, !report.hull_of_b ? "[\"A\"]" : !report.hull_of_a ? "[\"B\"]" : "[\"A\",\"B\"]");
  }
  if (report.resolution) {
    put(out, ",\"resolution\":{\"distance\":");
    put(out, report.resolution->distance);
    put(out, ",\"angle\":");
    put(out, angle);
    put(out, ",\"sine\":");
    put(out, report.resolution->sine);
    put(out, "}");
  }
  fmt::format_to(std::back_inserter(out), ",\"decided_by\":{{\"filter\":{},\"exact\":{}}}}}",
                 report.decided_by.filter, report.decided_by.exact);
  return fmt::to_string(out);
}

std::string contact_error_json(const std::vector<std::string>& messages) {
  return json_text({{"error", messages}});
}

std::string contact_report_text(const ContactReport& report, std::string_view a, std::string_view b) {
  Buffer out;
  fmt::format_to(std::back_inserter(out), "A = {}, B = {}: {}", a, b, to_string(report.relation));
  if (report.convex && report.convex->type != ContactType::crossing)
    fmt::format_to(std::back_inserter(out), ", {}", to_string(report.convex->type));
  put(out, "\n");
  if (report.hull_of_a) put(out, "  A is concave by rounding: taken as the convex hull of its points\n");
  if (report.hull_of_b) put(out, "  B is concave by rounding: taken as the convex hull of its points\n");
  if (report.resolution && !report.convex)
    fmt::format_to(std::back_inserter(out), "  all contacts up to distance {} m\n",
                   report.resolution->distance);
  if (report.resolution && report.convex)
    fmt::format_to(std::back_inserter(out), "  type and contacts at distance {} m, sine of the angle {}\n",
                   report.resolution->distance, report.resolution->sine);
  fmt::format_to(std::back_inserter(out), "  squared distance {}\n", report.squared_distance);
  if (report.convex)
    fmt::format_to(std::back_inserter(out), "  direction from B to A {} ({})\n",
                   text_of(report.convex->direction), name_of(report.convex->rule));
  if (report.relation == Relation::crossing && report.convex) {
    fmt::format_to(std::back_inserter(out), "  depth {}\n", report.depth);
    for (const Vector3& t : report.minimal_translations)
      fmt::format_to(std::back_inserter(out), "  ends by moving A by {}\n", text_of(t));
  }
  for (const ReportedContact& contact : report.contacts)
    put_contact_text(out, contact, report.convex.has_value());
  fmt::format_to(std::back_inserter(out), "  decided by filters {}, by exact arithmetic {}\n",
                 report.decided_by.filter, report.decided_by.exact);
  return fmt::to_string(out);
}

}  // namespace ashlar
