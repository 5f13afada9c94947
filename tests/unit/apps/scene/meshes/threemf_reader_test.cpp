#include "apps/scene/meshes/threemf_reader.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <zlib.h>

#include "geometry/solid/polyhedron.hpp"
#include "geometry/solid/shapes.hpp"

namespace ashlar::test::threemf_reader_test {
namespace {

using ::testing::HasSubstr;

const std::string core = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";

std::string cube_mesh() {
  const TriangleMesh cube = make_box(Vector3::Zero(), Vector3::Ones());
  std::string text = "<mesh><vertices>";
  for (const Vector3& p : cube.points)
    text += fmt::format(R"(<vertex x="{}" y="{}" z="{}"/>)", p.x(), p.y(), p.z());
  text += "</vertices><triangles>";
  for (const auto& t : cube.triangles)
    text += fmt::format(R"(<triangle v1="{}" v2="{}" v3="{}"/>)", t[0], t[1], t[2]);
  return text + "</triangles></mesh>";
}

std::string model(const std::string& objects, const std::string& items, const std::string& attributes = "") {
  return "<model unit=\"meter\" xmlns=\"" + core + "\" " + attributes + ">\n<resources>" + objects +
         "</resources>\n<build>" + items + "</build>\n</model>";
}

std::string cube_object() {
  return R"(<object id="7" name="pier">)" + cube_mesh() + "</object>";
}

template <class Read>
std::string refusal(Read read) {
  try {
    (void)read().whole();
  } catch (const MeshFileError& error) {
    return fmt::format("{}:{}: {}", error.line(), error.column(), error.what());
  }
  return "taken";
}

std::string refusal_of(const std::string& xml) {
  return refusal([&] { return read_3mf_model(xml); });
}

TEST(ThreemfReader, ComponentsArePlacedByRowsOfMatrices) {
  // Twice as large, then at x = 100; the second component 5 above the first, before that.
  const std::vector<MeshGroup> groups =
      read_3mf_model(model(cube_object() + R"(<object id="9"><components><component objectid="7"/>
<component objectid="7" transform="0 1 0 -1 0 0 0 0 1 0 0 5"/></components></object>)",
                           R"(<item objectid="9" transform="2 0 0 0 2 0 0 0 2 100 0 0"/>)"))
          .groups();
  const TriangleMesh cube = make_box(Vector3::Zero(), Vector3::Ones());
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].name, "Object_7");
  EXPECT_EQ(groups[1].name, "Object_7_2");
  for (std::size_t k = 0; k < 8; ++k) {
    const Vector3 p = cube.points[k];
    EXPECT_EQ(groups[0].mesh.points[k], Vector3(100 + 2 * p.x(), 2 * p.y(), 2 * p.z()));
    EXPECT_EQ(groups[1].mesh.points[k], Vector3(100 - 2 * p.y(), 2 * p.x(), 2 * p.z() + 10));
  }
}

TEST(ThreemfReader, MirroredItemsKeepTheirOutside) {
  const TriangleMesh mesh =
      read_3mf_model(model(cube_object(), R"(<item objectid="7" transform="-1 0 0 0 1 0 0 0 3 0 0 0"/>)"))
          .whole();
  EXPECT_EQ(Polyhedron(mesh).volume(), 3.0);
}

TEST(ThreemfReader, PrefixesAndOtherElementsChangeNothing) {
  std::string text = model("<basematerials id=\"1\"><base name=\"a\"/></basematerials>" + cube_object(),
                           R"(<item objectid="7"/>)", "xmlns:x=\"other\"");
  EXPECT_EQ(read_3mf_model(text).whole().triangles.size(), 12U);
  text.insert(text.find("</mesh>"),
              "<x:triangle v1=\"99\"/><trianglesets><triangle v1=\"99\"/></trianglesets>");
  EXPECT_EQ(read_3mf_model(text).whole().triangles.size(), 12U);
  std::string prefixed = "<?xml version=\"1.0\"?>" + text;
  for (const char* name : {"model", "resources", "object", "mesh", "vertices", "vertex", "triangles",
                           "triangle ", "build", "item"})
    for (const std::string begin : {"<", "</"})
      for (std::size_t at = prefixed.find(begin + name); at != std::string::npos;
           at = prefixed.find(begin + name, at + 5))
        if (prefixed.compare(at, 13, "<trianglesets") != 0 && prefixed.compare(at, 14, "</trianglesets") != 0)
          prefixed.insert(at + begin.size(), "ns:");
  prefixed.replace(prefixed.find("xmlns="), 6, "xmlns:ns=");
  EXPECT_EQ(read_3mf_model(prefixed).whole().triangles.size(), 12U) << prefixed;
}

TEST(ThreemfReader, ObjectsStandAboveThoseThatUseThem) {
  const std::string uses_8 = R"(<object id="1"><components><component objectid="8"/></components></object>)";
  const std::string uses_1 = R"(<object id="8"><components><component objectid="1"/></components></object>)";
  const std::string item = R"(<item objectid="1"/>)";
  EXPECT_THAT(refusal_of(model(uses_8 + uses_1, item)),
              HasSubstr("2:39: component of object 8, allowed are objects"));
  EXPECT_THAT(refusal_of(model(
                  R"(<object id="1"><components><component objectid="1"/></components></object>)", item)),
              HasSubstr("component of object 1"));
  EXPECT_THAT(refusal_of(model(cube_object(), item)), HasSubstr("item of object 1"));
  EXPECT_THAT(refusal_of(model(cube_object() + cube_object(), item)), HasSubstr("two objects with the id 7"));
}

TEST(ThreemfReader, DoublingIsBounded) {
  const auto levels = [](int count) {
    std::string objects = "<object id=\"0\">" + cube_mesh() + "</object>";
    for (int k = 1; k <= count; ++k)
      objects += fmt::format(
          R"(<object id="{}"><components><component objectid="{}"/><component objectid="{}"/></components></object>)",
          k, k - 1, k - 1);
    return model(objects, fmt::format(R"(<item objectid="{}"/>)", count));
  };
  // 2^10 cubes at one place, with 2^11 - 1 placements.
  EXPECT_EQ(read_3mf_model(levels(10)).groups().size(), 1024U);
  EXPECT_THAT(refusal_of(levels(40)), HasSubstr("times, which is what is allowed"));
  std::string empty = levels(40);
  empty.replace(empty.find(cube_mesh()), cube_mesh().size(), "");
  EXPECT_THAT(refusal_of(empty), HasSubstr("times, which is what is allowed"));
}

TEST(ThreemfReader, FaultsAreNamedWithTheirPlace) {
  const std::string good = model(cube_object(), R"(<item objectid="7"/>)");
  const auto changed = [&](const std::string& part, const std::string& by) {
    std::string text = good;
    return refusal_of(text.replace(text.find(part), part.size(), by));
  };
  EXPECT_EQ(refusal_of(good), "taken");
  EXPECT_THAT(changed("v1=\"0\"", "v1=\"8\""), HasSubstr("v1 (8), allowed 0 to 7"));
  EXPECT_THAT(changed("v1=\"0\"", "v1=\"-1\""), HasSubstr("v1 (-1), allowed 0 to 7"));
  EXPECT_THAT(changed("v1=\"0\"", ""), HasSubstr("triangle without v1"));
  EXPECT_THAT(changed("x=\"0\"", "x=\"nan\""), HasSubstr("x (nan), must be a number"));
  EXPECT_THAT(changed("x=\"0\"", "x=\"\""), HasSubstr("vertex with an empty x"));
  EXPECT_THAT(changed("x=\"0\"", "x=\"1e200\""), HasSubstr("x (1e200), allowed -1e150 to 1e150"));
  EXPECT_THAT(changed("x=\"0\"", "x=\"0 1\""), HasSubstr("2:"));
  EXPECT_THAT(changed("/></build>", " transform=\"1 0 0 0 1 0 0 0 1 0 0\"/></build>"), HasSubstr("3:8: "));
  EXPECT_THAT(changed("/></build>", " transform=\"1 0 0 0 1 0 0 0 0 0 0 0\"/></build>"),
              HasSubstr("singular"));
  EXPECT_THAT(changed("/></build>", " p:path=\"/3D/b.model\"/></build>"),
              HasSubstr("another part of the package"));
  EXPECT_THAT(changed("id=\"7\"", "id=\"2147483648\""),
              HasSubstr("id (2147483648), allowed 0 to 2147483647"));
  EXPECT_THAT(changed("2015/02", "2013/01"), HasSubstr("allowed is model of " + core));
  EXPECT_THAT(changed("</mesh>", "</mush>"), HasSubstr("no well-formed XML (mismatched tag)"));
  EXPECT_THAT(changed("<build><item objectid=\"7\"/></build>", ""), HasSubstr("file has no faces"));
  EXPECT_THAT(refusal_of(good.substr(0, good.size() / 2)), HasSubstr("no well-formed XML"));
}

TEST(ThreemfReader, RequiredExtensionsThatChangeShapesAreRefused) {
  const auto with = [](const std::string& extension) {
    return refusal_of(
        model(cube_object(), R"(<item objectid="7"/>)",
              "requiredextensions=\"e\" xmlns:e=\"http://schemas.microsoft.com/3dmanufacturing/" + extension +
                  "\""));
  };
  EXPECT_EQ(with("material/2015/02"), "taken");
  EXPECT_EQ(with("production/2015/06"), "taken");
  EXPECT_THAT(with("beamlattice/2017/02"),
              HasSubstr("required extension \"http://schemas.microsoft.com/3dmanuf"));
}

TEST(ThreemfReader, EntitiesDepthAndLongTagsAreRefused) {
  EXPECT_THAT(refusal_of("<!DOCTYPE m [<!ENTITY a \"b\">]>" + model(cube_object(), "")),
              HasSubstr("document type declaration"));
  std::string deep;
  for (int k = 0; k < 100'000; ++k) deep += "<a>";
  EXPECT_THAT(refusal_of("<model>" + deep), HasSubstr("nested more than 100 deep"));
  EXPECT_THAT(refusal_of("<model><!--" + std::string(3U << 20U, ' ')),
              HasSubstr("comment of more than 1048576 bytes"));
  EXPECT_THAT(refusal_of("<model a=\"" + std::string(3U << 20U, ' ')),
              HasSubstr("tag or comment of more than"));
  // Text is no tag.
  EXPECT_EQ(refusal_of(model(cube_object() + std::string(3U << 20U, ' '), R"(<item objectid="7"/>)")),
            "taken");
}

struct Part {
  std::string name;
  std::string content;
};

template <class... Values>
std::string bytes_of(Values... values) {
  std::string bytes;
  (bytes.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
  return bytes;
}

/// Deflated without zlib's header and checksum.
std::string deflated(const std::string& content) {
  std::string packed(compressBound(content.size()), '\0');
  uLongf size = packed.size();
  compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(content.data()),
            content.size(), 9);
  return packed.substr(2, size - 6);
}

std::string package(const std::vector<Part>& parts) {
  using Short = std::uint16_t;
  using Word = std::uint32_t;
  std::string entries;
  std::string directory;
  for (const Part& part : parts) {
    const std::string packed = deflated(part.content);
    const auto checksum = static_cast<Word>(crc32(0, reinterpret_cast<const Bytef*>(part.content.data()),
                                                  static_cast<uInt>(part.content.size())));
    const std::string sizes =
        bytes_of(Short{20}, Short{0}, Short{8}, Word{0}, checksum, static_cast<Word>(packed.size()),
                 static_cast<Word>(part.content.size()), static_cast<Short>(part.name.size()));
    for (const std::string& piece : {bytes_of(Word{0x02014b50}, Short{20}), sizes, std::string(12, '\0'),
                                     bytes_of(static_cast<Word>(entries.size())), part.name})
      directory += piece;
    for (const std::string& piece :
         {bytes_of(Word{0x04034b50}), sizes, bytes_of(Short{0}), part.name, packed})
      entries += piece;
  }
  return entries + directory +
         bytes_of(Word{0x06054b50}, Word{0}, static_cast<Short>(parts.size()),
                  static_cast<Short>(parts.size()), static_cast<Word>(directory.size()),
                  static_cast<Word>(entries.size()), Short{0});
}

const Part relationships = {"_rels/.rels",
                            R"(<Relationships><Relationship Target="/3D/a.model" Id="r"
Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>)"};

std::string package_refusal(const std::string& bytes) {
  return refusal([&] { return read_3mf(bytes); });
}

TEST(ThreemfReader, PackagesAreArchives) {
  const std::string text = model(cube_object(), R"(<item objectid="7"/>)");
  const std::string good = package({relationships, {"3d/A.model", text}});  // names in any case
  EXPECT_EQ(Polyhedron(read_3mf(good).whole()).volume(), 1.0);
  EXPECT_THAT(package_refusal("v 0 0 0"), HasSubstr("no zip archive"));
  EXPECT_THAT(package_refusal(package({{"a", "b"}})), HasSubstr("no _rels/.rels in the package"));
  EXPECT_THAT(package_refusal(package({relationships})), HasSubstr("no 3D/a.model in the package"));
  EXPECT_THAT(package_refusal(package({{"_rels/.rels", "<Relationships/>"}})), HasSubstr("no 3-D model"));
  EXPECT_THAT(package_refusal(package({relationships, {"3D/a.model", "<model/>" + text}})),
              HasSubstr("1:9: 3D/a.model: no well-formed XML"));
  for (std::size_t size = 0; size < good.size(); size += 5)
    EXPECT_THROW((void)read_3mf(good.substr(0, size)), MeshFileError) << size;
}

TEST(ThreemfReader, DamagedEntriesAreRefused) {
  const std::string good =
      package({relationships, {"3D/a.model", model(cube_object(), R"(<item objectid="7"/>)")}});
  const std::size_t directory = good.find("PK\x01\x02");
  const std::size_t second = good.find("PK\x01\x02", directory + 4);
  const auto with = [&](std::size_t place, const std::string& by) {
    std::string bytes = good;
    return package_refusal(bytes.replace(place, by.size(), by));
  };
  const std::string largest = bytes_of(0xffffffffU);
  EXPECT_THAT(with(second + 8, "\x01"), HasSubstr("is encrypted"));
  EXPECT_THAT(with(second + 10, "\x0c"), HasSubstr("packed by method 12"));
  EXPECT_THAT(with(second + 16, largest), HasSubstr("damaged (its size or checksum)"));
  EXPECT_THAT(with(second + 20, bytes_of(0xfffffffeU)), HasSubstr("claims 4294967294 bytes"));
  EXPECT_THAT(with(second + 24, bytes_of(0xfffffffeU)), HasSubstr("damaged (its size or checksum)"));
  EXPECT_THAT(with(second + 42, bytes_of(7U)), HasSubstr("not where its directory says"));
  EXPECT_THAT(with(second + 42, largest), HasSubstr("damaged"));
  EXPECT_THAT(with(good.size() - 22 + 16, largest), HasSubstr("directory is not in the file"));
  EXPECT_THAT(with(good.size() - 22 + 10, bytes_of(std::uint16_t{0xffff})), HasSubstr("damaged"));
}

TEST(ThreemfReader, InflatingIsBounded) {
  EXPECT_EQ(most_inflated(1000), 16U << 20U);
  EXPECT_EQ(most_inflated(1U << 20U), 100U << 20U);
  const std::string head = model(cube_object(), R"(<item objectid="7"/>)");
  const auto padded = [&](std::size_t blanks) {
    return package({relationships, {"3D/a.model", head + std::string(blanks, ' ')}});
  };
  EXPECT_EQ(package_refusal(padded((16U << 20U) - head.size())), "taken");
  EXPECT_THAT(package_refusal(padded((16U << 20U) - head.size() + 1)),
              HasSubstr("inflates to more than 16777216 bytes"));
}

}  // namespace
}  // namespace ashlar::test::threemf_reader_test
