#include "apps/program/contacts/contacts_command.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/program/contacts/contact_report_json.hpp"
#include "geometry/solid/shapes.hpp"
#include "support/sample_meshes.hpp"
#include "support/temporary_folder.hpp"

namespace ashlar::test::contacts_command_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

struct Outcome {
  int status;
  std::string out;
  std::string err;
};

Outcome run(const ContactsOptions& options) {
  std::ostringstream out, err;
  const int status = contacts_command(options, out, err);
  return {status, out.str(), err.str()};
}

Outcome run_line(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "contacts");
  std::ostringstream out, err;
  const int status = run_command_line(std::move(arguments), out, err);
  return {status, out.str(), err.str()};
}

class ContactsCommand : public ::testing::Test {
 protected:
  std::string write_off(const std::string& name, const TriangleMesh& mesh) {
    std::ofstream file(folder_ / name);
    file << "OFF\n" << mesh.points.size() << ' ' << mesh.triangles.size() << " 0\n" << std::setprecision(17);
    for (const Vector3& p : mesh.points) file << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    for (const auto& [a, b, c] : mesh.triangles) file << "3 " << a << ' ' << b << ' ' << c << '\n';
    return (folder_ / name).string();
  }
  std::string write_cube(const std::string& name, const Vector3& low) {
    return write_off(name, make_box(low, low + Vector3::Ones()));
  }
  std::string write_list(const std::string& text) {
    write_text(folder_ / "list", text);
    return (folder_ / "list").string();
  }
  static std::vector<json> lines_of(const std::string& text) {
    std::vector<json> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(json::parse(line));
    return lines;
  }

  TemporaryFolder folder_;
};

TEST_F(ContactsCommand, JsonOfTwoCubesFaceToFace) {
  const std::string a = write_cube("a.off", {0, 0, 1}), b = write_cube("b.off", {0, 0, 0});
  const Outcome outcome = run_line({a, b, "--json"});
  EXPECT_EQ(outcome.status, exit_status::done);
  EXPECT_EQ(outcome.err, "");
  const json report = json::parse(outcome.out);
  EXPECT_EQ(report["relation"], "touching");
  EXPECT_EQ(report["type"], "F-F");
  EXPECT_EQ(report["a_dim"], 2);
  EXPECT_EQ(report["b_dim"], 2);
  EXPECT_EQ(report["region_dim"], 2);
  EXPECT_EQ(report["squared_distance"], 0.0);
  EXPECT_EQ(report["direction"], json({0, 0, 1}));
  EXPECT_EQ(report["region"].size(), 4u);
  EXPECT_EQ(report["depth"], 0.0);
  EXPECT_EQ(report["minimal_translations"], json::array());
  EXPECT_TRUE(report["decided_by"].contains("filter"));
  EXPECT_TRUE(report["decided_by"].contains("exact"));
  EXPECT_FALSE(report.contains("resolution"));
  ASSERT_EQ(report["contacts"].size(), 1u);
  const json& contact = report["contacts"][0];
  EXPECT_EQ(contact["a"], "face 0");
  EXPECT_EQ(contact["b"], "face 1");
  EXPECT_EQ(contact["area"], 1.0);
  EXPECT_EQ(contact["points"].size(), 4u);
  for (const json& p : contact["points"]) {
    EXPECT_EQ(p["pair"], "V-V");
    EXPECT_EQ(p["face_of"], "B");
    EXPECT_EQ(p["plane"]["normal"], json({0, 0, 1}));
    EXPECT_EQ(p["plane"]["point"][2], 1.0);
    EXPECT_EQ(p["point"], p["foot"]);
    EXPECT_EQ(p["gap"], 0.0);
  }
}

TEST_F(ContactsCommand, NumbersGiveTheSameDoublesBack) {
  const double gap = 0.1;
  const std::string a = write_cube("a.off", {0.1, 0.7, 1.0 + gap}), b = write_cube("b.off", {0, 0, 0});
  const json report = json::parse(run({a, b, {}, {}, {}, true}).out);
  // 1 + 0.1 is a double, and so is its difference from 1 (Sterbenz); the square is rounded once.
  const double exact_gap = (1.0 + gap) - 1.0;
  EXPECT_EQ(report["squared_distance"].get<double>(), exact_gap * exact_gap);
  EXPECT_EQ(report["contacts"][0]["points"][0]["gap"].get<double>(), exact_gap);
  EXPECT_EQ(report["region"][0][2].get<double>(), 1.0 + gap);
}

TEST_F(ContactsCommand, OverlapOfAQuarter) {
  const std::string a = write_cube("a.off", {0, 0, 0.75}), b = write_cube("b.off", {0, 0, 0});
  const json report = json::parse(run({a, b, {}, {}, {}, true}).out);
  EXPECT_EQ(report["relation"], "crossing");
  EXPECT_EQ(report["type"], "crossing");
  EXPECT_EQ(report["depth"], 0.25);
  EXPECT_EQ(report["minimal_translations"], json({{0, 0, 0.25}}));
  EXPECT_EQ(report["contacts"], json::array());
}

TEST_F(ContactsCommand, TextSaysTheSame) {
  const std::string a = write_cube("a.off", {0, 0, 1}), b = write_cube("b.off", {0, 0, 0});
  const Outcome outcome = run_line({a, b});
  EXPECT_THAT(outcome.out, AllOf(StartsWith("A = " + a + ", B = " + b + ": touching, F-F\n"),
                                 HasSubstr("F-F contact: face 0 of A, face 1 of B, area 1\n"),
                                 HasSubstr("squared distance 0\n")));
}

TEST_F(ContactsCommand, ResolutionIsStoredWithTheAnswer) {
  const std::string a = write_cube("a.off", {0, 0, 1.5}), b = write_cube("b.off", {0, 0, 0});
  const json report = json::parse(run_line({a, b, "--distance", "0.25", "--angle", "90", "--json"}).out);
  EXPECT_EQ(report["resolution"]["distance"], 0.25);
  EXPECT_EQ(report["resolution"]["angle"], 90.0);
  EXPECT_EQ(report["resolution"]["sine"], 1.0);
  EXPECT_EQ(report["squared_distance"], 0.25);
}

TEST_F(ContactsCommand, SolidsThatAreNotConvexHaveContactsButNoType) {
  const std::string a = write_cube("a.off", {1, 1, 0}), b = write_off("l.off", test_support::make_l_prism());
  const json report = json::parse(run({a, b, {}, {}, {}, true}).out);
  EXPECT_EQ(report["relation"], "touching");
  EXPECT_TRUE(report["type"].is_null());
  EXPECT_EQ(report["squared_distance"], 0.0);
  EXPECT_EQ(report["contacts"].size(), 2u);
  const json crossing = json::parse(run({b, b, {}, {}, {}, true}).out);
  EXPECT_EQ(crossing["relation"], "crossing");
  EXPECT_TRUE(crossing["depth"].is_null());
  const Outcome refused = run({a, b, {}, {}, 1.0, true});
  EXPECT_EQ(refused.status, exit_status::bad_input);
  EXPECT_THAT(refused.err, StartsWith(b + ": error: solid is not convex"));
}

TEST_F(ContactsCommand, ContactDistanceGivesAllContactsOfSolidsThatAreNotConvex) {
  const std::string a = write_cube("a.off", {1.25, 1.5, 0}),
                    b = write_off("l.off", test_support::make_l_prism());
  EXPECT_EQ(json::parse(run({a, b, {}, {}, {}, true}).out)["contacts"].size(), 1u);
  const json report = json::parse(run({a, b, {}, 0.5, {}, true}).out);
  EXPECT_EQ(report["relation"], "apart");
  EXPECT_EQ(report["squared_distance"], 0.0625);
  EXPECT_EQ(report["resolution"]["distance"], 0.5);
  ASSERT_EQ(report["contacts"].size(), 2u);
  std::map<double, json> by_distance;
  for (const json& contact : report["contacts"]) by_distance[contact["squared_distance"]] = contact;
  EXPECT_EQ(by_distance.at(0.0625)["direction"], json({1, 0, 0}));
  EXPECT_EQ(by_distance.at(0.25)["direction"], json({0, 1, 0}));
  EXPECT_EQ(by_distance.at(0.25)["area"], 0.75);
  EXPECT_THAT(run({a, b, {}, 0.5, {}, false}).out,
              AllOf(HasSubstr("all contacts up to distance 0.5 m\n"),
                    HasSubstr("area 0.75, squared distance 0.25, direction from B to A (0, 1, 0)\n")));
}

TEST_F(ContactsCommand, EveryDefectOfBothMeshesIsListed) {
  TriangleMesh open = make_box({0, 0, 0}, {1, 1, 1});
  open.triangles.pop_back();
  const std::string a = write_off("a.off", open);
  write_text(folder_ / "b.off", "OFF\n3 1 0\n0 0 0\n1 0 zero\n0 1 0\n3 0 1 2\n");
  const Outcome outcome = run({a, (folder_ / "b.off").string(), {}, {}, {}, true});
  EXPECT_EQ(outcome.status, exit_status::bad_input);
  EXPECT_EQ(outcome.out, "");
  // The missing triangle 1, 7, 5 leaves three edges.
  for (const std::string edge : {"1-5 of triangle 4", "1-7 of triangle 10", "5-7 of triangle 2"})
    EXPECT_THAT(outcome.err, HasSubstr(fmt::format("{}: error: open edge: edge {}", a, edge)));
  EXPECT_THAT(outcome.err, HasSubstr((folder_ / "b.off").string() + ":4:5: error: "));
}

TEST_F(ContactsCommand, MissingFileIsNamed) {
  const std::string a = write_cube("a.off", {0, 0, 0});
  const Outcome outcome = run({a, "missing.off", {}, {}, {}, true});
  EXPECT_EQ(outcome.status, exit_status::bad_input);
  EXPECT_EQ(outcome.err, "missing.off: error: mesh file does not exist\n");
}

TEST_F(ContactsCommand, PairsAreAnsweredInOrderAndBadOnesInTheirPlace) {
  const std::string a = write_cube("a.off", {0, 0, 1}), b = write_cube("b b.off", {0, 0, 0}),
                    c = write_cube("c.off", {0, 0, 3});
  TriangleMesh open = make_box({0, 0, 0}, {1, 1, 1});
  open.triangles.pop_back();
  write_off("open.off", open);
  // Absolute names, one with a blank; names beside the list; a comment; faults in lines 4, 5 and 6.
  const std::string list =
      write_list(a + " \"" + b + "\"\n# c\n\n  c.off \"open.off\"\na.off\na.off \"b b.off\nc.off a.off\n");
  const Outcome outcome = run_line({"--pairs", list, "--json"});
  EXPECT_EQ(outcome.status, exit_status::bad_input);
  const std::vector<json> lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[0]["type"], "F-F");
  EXPECT_EQ(lines[1]["error"].size(), 3u);
  EXPECT_EQ(lines[2]["error"].size(), 1u);
  EXPECT_EQ(lines[3]["error"].size(), 1u);
  EXPECT_EQ(lines[4]["squared_distance"], 1.0);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr(list + ":4:9: error: open.off: open edge: edge 1-5"),
                                 HasSubstr(list + ":5:1: error: number of files (1)"),
                                 HasSubstr(list + ":6:7: error: quote is not closed")));
}

TEST_F(ContactsCommand, APairOfTheSameBadMeshHasItsFaultsOnceAndLeavesOthersTheirAnswers) {
  write_cube("a.off", {0, 0, 1});
  write_cube("b.off", {0, 0, 0});
  TriangleMesh open = make_box({0, 0, 0}, {1, 1, 1});
  open.triangles.pop_back();
  write_off("open.off", open);
  const std::string list =
      write_list("a.off b.off\nmissing.off missing.off\nopen.off open.off\nb.off a.off\na.off a.off\n");
  const Outcome outcome = run_line({"--pairs", list, "--json"});
  EXPECT_EQ(outcome.status, exit_status::bad_input);
  const std::vector<json> lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[0]["type"], "F-F");
  EXPECT_EQ(lines[1]["error"], json({list + ":2:1: error: missing.off: mesh file does not exist"}));
  EXPECT_EQ(lines[2]["error"].size(), 3u);
  EXPECT_EQ(lines[3]["type"], "F-F");
  EXPECT_EQ(lines[4]["relation"], "crossing");
  const std::string open_mesh = (folder_ / "open.off").string();
  const Outcome two = run({open_mesh, open_mesh, {}, {}, {}, true});
  EXPECT_EQ(std::count(two.err.begin(), two.err.end(), '\n'), 3);
}

TEST_F(ContactsCommand, NumbersThatAreNotFiniteAreNull) {
  ContactReport report;
  report.contacts.push_back({});
  report.contacts[0].area = std::numeric_limits<double>::infinity();
  report.squared_distance = std::numeric_limits<double>::quiet_NaN();
  const json parsed = json::parse(contact_report_json(report, 0.0));
  EXPECT_TRUE(parsed["contacts"][0]["area"].is_null());
  EXPECT_TRUE(parsed["squared_distance"].is_null());
}

TEST_F(ContactsCommand, LongListsKeepTheirOrder) {
  // Heights 1, 2, ... above the same cube, each file used twice.
  constexpr int count = 700;
  write_cube("b.off", {0, 0, 0});
  std::string text;
  for (int i = 0; i < count; ++i) {
    const std::string name = fmt::format("a{}.off", i);
    write_cube(name, {0, 0, 2.0 + i});
    text += fmt::format("{0} b.off\nb.off {0}\n", name);
  }
  const std::vector<json> lines = lines_of(run({"", "", write_list(text), {}, {}, true}).out);
  ASSERT_EQ(lines.size(), 2u * count);
  for (int i = 0; i < count; ++i) {
    EXPECT_EQ(lines[2 * i]["squared_distance"], (1.0 + i) * (1.0 + i));
    EXPECT_EQ(lines[2 * i]["direction"], json({0, 0, 1}));
    EXPECT_EQ(lines[2 * i + 1]["direction"], json({0, 0, -1}));
  }
}

TEST_F(ContactsCommand, UsageFaultsEndWithTwo) {
  const std::string a = write_cube("a.off", {0, 0, 1});
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{},
                                                    {a},
                                                    {a, a, "--pairs", "list"},
                                                    {a, a, "--distance", "-1"},
                                                    {a, a, "--distance", "nan"},
                                                    {a, a, "--angle", "91"},
                                                    {a, a, "--angle", "nan"}}) {
    const Outcome outcome = run_line(arguments);
    EXPECT_EQ(outcome.status, exit_status::bad_input) << ::testing::PrintToString(arguments);
    EXPECT_THAT(outcome.err, StartsWith("ashlar: error: "));
  }
  EXPECT_EQ(run({"", "", (folder_ / "missing").string(), {}, {}, true}).status, exit_status::bad_input);
  EXPECT_EQ(run({"", "", folder_.path().string(), {}, {}, true}).status, exit_status::bad_input);
  EXPECT_EQ(run({"", "", write_list(""), {}, {}, true}).status, exit_status::done);
}

TEST_F(ContactsCommand, FileNamesThatAreNoTextStillGiveJson) {
  EXPECT_TRUE(json::accept(contact_error_json({"a\xff\"b"})));
}

}  // namespace
}  // namespace ashlar::test::contacts_command_test
