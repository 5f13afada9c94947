#include "apps/results/text/xml_text.hpp"

#include <gtest/gtest.h>

namespace ashlar::xml_text_test {
namespace {

TEST(EscapeXml, ReplacesWhatXmlReserves) {
  EXPECT_EQ(escape_xml("a < b && \"c\" > d"), "a &lt; b &amp;&amp; &quot;c&quot; &gt; d");
  EXPECT_EQ(escape_xml(""), "");
}

TEST(UnescapeXml, UndoesEscaping) {
  EXPECT_EQ(unescape_xml("a &lt; b &amp;&amp; &quot;c&quot; &gt; d"), "a < b && \"c\" > d");
  EXPECT_EQ(unescape_xml("&amp;lt; & &other;"), "&lt; & &other;");
}

TEST(XmlAttribute, IsFoundByItsWholeName) {
  const char* tag = "<DataArray SubName=\"no\" Name=\"a &lt; b\" open=\"x/>";
  EXPECT_EQ(xml_attribute(tag, "Name"), "a < b");
  EXPECT_EQ(xml_attribute(tag, "offset"), std::nullopt);
  EXPECT_EQ(xml_attribute(tag, "open"), std::nullopt);
}

TEST(XmlAttribute, IsNotLookedForInValues) {
  const char* tag = "<DataArray Name=\" offset=\" offset=\"7\"/>";
  EXPECT_EQ(xml_attribute(tag, "Name"), " offset=");
  EXPECT_EQ(xml_attribute(tag, "offset"), "7");
}

}  // namespace
}  // namespace ashlar::xml_text_test
