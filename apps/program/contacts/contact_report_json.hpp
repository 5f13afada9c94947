// A contact report as one line of JSON, and as text.
#pragma once

#include <string>
#include <string_view>

#include "geometry/contacts/contact_report.hpp"

namespace ashlar {

/// One JSON object without line breaks. Numbers are the shortest decimals that read back as the same double. Keys:
/// relation, type, a_dim, b_dim, region_dim, squared_distance, direction, direction_rule, region, contacts, depth,
/// minimal_translations, decided_by; "hull_of": ["A"] if a mesh that is concave by rounding was replaced by the hull
/// of its points; "resolution": {distance, angle, sine} if one was requested. type, a_dim, b_dim, region_dim,
/// direction, direction_rule and depth are null if undefined.
/// @param angle the contact angle as the user gave it, deg; used with a resolution only.
[[nodiscard]] std::string contact_report_json(const ContactReport& report, double angle = 0.0);

/// {"error": [messages]}, one line.
[[nodiscard]] std::string contact_error_json(const std::vector<std::string>& messages);

/// Several complete lines.
/// @param a,b names of the two bodies.
[[nodiscard]] std::string contact_report_text(const ContactReport& report, std::string_view a,
                                              std::string_view b);

}  // namespace ashlar
