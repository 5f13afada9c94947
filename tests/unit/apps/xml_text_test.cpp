#include "apps/xml_text.hpp"

#include <gtest/gtest.h>

namespace ashlar {
namespace {

TEST(EscapeXml, ReplacesWhatXmlReserves) {
  EXPECT_EQ(escape_xml("a < b && \"c\" > d"), "a &lt; b &amp;&amp; &quot;c&quot; &gt; d");
  EXPECT_EQ(escape_xml(""), "");
}

}  // namespace
}  // namespace ashlar
