// A contact report as one line of JSON, and as text to read.
#pragma once

#include <string>
#include <string_view>

#include "geometry/contacts/contact_report.hpp"

namespace ashlar {

/// One JSON object without line breaks. Numbers are the shortest decimals that give the same double back.
/// Keys: relation, type, a_dim, b_dim, region_dim, squared_distance, direction, direction_rule, region,
/// contacts, depth, minimal_translations, decided_by; "hull_of": ["A"] where a mesh that is concave by
/// rounding was taken as the hull of its points; "resolution": {distance, angle, sine} if one was asked for.
/// type, a_dim, b_dim, region_dim, direction, direction_rule and depth are null where they are not defined.
/// @param angle the contact angle as the user gave it, deg; used with a resolution only.
[[nodiscard]] std::string contact_report_json(const ContactReport& report, double angle = 0.0);

/// {"error": [messages]}, one line.
[[nodiscard]] std::string contact_error_json(const std::vector<std::string>& messages);

/// Several lines, each ended.
/// @param a,b what to call the two bodies.
[[nodiscard]] std::string contact_report_text(const ContactReport& report, std::string_view a,
                                              std::string_view b);

}  // namespace ashlar
