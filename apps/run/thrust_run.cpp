#include "apps/run/thrust_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "apps/results/atomic_file.hpp"
#include "apps/run/limit_run.hpp"
#include "solver/statics/limit_analysis.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

const std::string& name_of(const Simulation& simulation, int block) {
  return simulation.blocks()[static_cast<std::size_t>(block)].name();
}

ThrustLine line_of(const RigidModel& model, const ThrustState& state) {
  return {state.thrust, state.gap, joint_resultants(model, state.force)};
}

Json to_json(const ThrustLine& line, const Simulation& simulation) {
  const auto array = [](const Vector3& v) { return Json{v.x(), v.y(), v.z()}; };
  Json json = Json::array();
  for (const JointResultant& joint : line.joints)
    json.push_back(
        {{"blocks", Json{name_of(simulation, joint.blocks[0]), name_of(simulation, joint.blocks[1])}},
         {"place", array(joint.place)},
         {"force", array(joint.force)}});
  return json;
}

/// Where a drawing looks along, and how large it is.
class View {
 public:
  View(const Scene& scene, const Simulation& simulation) {
    const Vector3& gravity = scene.analysis.gravity;
    up_ = gravity.squaredNorm() > 0.0 ? Vector3(-gravity.normalized()) : Vector3(Vector3::UnitZ());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    Vector3 middle = Vector3::Zero();
    int count = 0;
    for (const BlockModel& block : simulation.blocks()) {
      if (block.fixed()) continue;
      middle += block.basis().centroid();
      ++count;
    }
    middle /= std::max(count, 1);
    for (const BlockModel& block : simulation.blocks()) {
      if (block.fixed()) continue;
      const Vector3 arm = block.basis().centroid() - middle;
      const Vector3 level = arm - arm.dot(up_) * up_;
      spread += level * level.transpose();
    }
    along_ = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(2);
    along_ -= along_.dot(up_) * up_;
    if (along_.norm() < 1e-6) along_ = up_.unitOrthogonal();
    along_.normalize();
    for (const BlockModel& block : simulation.blocks()) {
      if (block.fixed()) continue;
      for (const Vector3& point : block.solid().mesh().points) {
        const Eigen::Vector2d seen(point.dot(along_), point.dot(up_));
        low_ = low_.cwiseMin(seen);
        high_ = high_.cwiseMax(seen);
      }
    }
    scale_ = (width - 2.0 * margin) / std::max((high_ - low_).maxCoeff(), 1e-300);
  }

  [[nodiscard]] std::string at(const Vector3& point) const {
    return fmt::format("{:.2f},{:.2f}", margin + scale_ * (point.dot(along_) - low_.x()),
                       margin + scale_ * (high_.y() - point.dot(up_)));
  }
  [[nodiscard]] double height() const { return 2.0 * margin + scale_ * (high_ - low_).y(); }

  static constexpr double width = 900.0, margin = 30.0;

 private:
  Vector3 up_, along_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Constant(1e300), high_ = Eigen::Vector2d::Constant(-1e300);
  double scale_ = 1.0;
};

/// The line of thrust: through each block from joint to joint, by way of the middle where it has more than two.
std::string drawn_line(const ThrustLine& line, const Simulation& simulation, const View& view,
                       const char* colour) {
  std::map<int, std::vector<const JointResultant*>> by_block;
  for (const JointResultant& joint : line.joints)
    for (const int block : joint.blocks)
      if (!simulation.blocks()[static_cast<std::size_t>(block)].fixed()) by_block[block].push_back(&joint);
  std::string text;
  const auto segment = [&](const Vector3& from, const Vector3& to) {
    text += fmt::format("<polyline points=\"{} {}\" stroke=\"{}\" stroke-width=\"2\" fill=\"none\"/>\n",
                        view.at(from), view.at(to), colour);
  };
  for (const auto& [block, joints] : by_block) {
    if (joints.size() == 2) {
      segment(joints[0]->place, joints[1]->place);
      continue;
    }
    Vector3 middle = Vector3::Zero();
    double weight = 0.0;
    for (const JointResultant* joint : joints) {
      middle += joint->force.norm() * joint->place;
      weight += joint->force.norm();
    }
    for (const JointResultant* joint : joints) segment(joint->place, middle / weight);
  }
  return text;
}

}  // namespace

ThrustFindings find_thrust(const Scene& scene, RigidModel model, const Simulation& simulation, int threads) {
  ThrustFindings findings;
  for (const ThrustRange& range : thrust_ranges(model, scene.analysis.gravity, threads)) {
    SupportThrust support{range.support, line_of(model, *range.least), std::nullopt};
    if (range.most) support.most = line_of(model, *range.most);
    findings.supports.push_back(std::move(support));
  }
  LimitAnalysis analysis(
      std::move(model), [](int, int) { return false; }, threads);
  const LimitTrial trial = analysis.associated({});
  if (trial.outcome == LimitOutcome::moves) {
    findings.supports.clear();
    findings.collapse = words_of(analysis.motion_of(trial), simulation);
  }
  return findings;
}

std::string describe(const ThrustFindings& findings, const Simulation& simulation) {
  if (!findings.collapse.empty()) return "nothing stands: " + findings.collapse;
  if (findings.supports.empty()) return "no thrust was found: forces in balance were not told from others";
  std::string text;
  for (const SupportThrust& support : findings.supports) {
    text += fmt::format("{}thrust on {} ", text.empty() ? "" : "; ", name_of(simulation, support.support));
    text += support.most
                ? fmt::format("between {:.5g} and {:.5g} N", support.least.thrust, support.most->thrust)
                : fmt::format("at least {:.5g} N, without bound above", support.least.thrust);
  }
  return text;
}

Json thrust_summary(const ThrustFindings& findings, const Simulation& simulation) {
  Json json = Json::array();
  for (const SupportThrust& support : findings.supports) {
    Json one = {{"support", name_of(simulation, support.support)},
                {"least", support.least.thrust},
                {"most", support.most ? Json(support.most->thrust) : Json(nullptr)},
                {"gap", std::max(support.least.gap, support.most ? support.most->gap : 0.0)},
                {"least_line", to_json(support.least, simulation)}};
    one["most_line"] = support.most ? to_json(*support.most, simulation) : Json(nullptr);
    json.push_back(std::move(one));
  }
  return json;
}

void draw_thrust(const ThrustFindings& findings, const Scene& scene, const Simulation& simulation,
                 const std::filesystem::path& path) {
  if (findings.supports.empty()) return;
  const View view(scene, simulation);
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1:.0f}\" width=\"{0}\" "
      "height=\"{1:.0f}\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      View::width, view.height() + 40.0);
  for (const BlockModel& block : simulation.blocks()) {
    if (block.fixed()) continue;
    const TriangleMesh& mesh = block.solid().mesh();
    for (const auto& triangle : mesh.triangles) {
      std::string points;
      for (const int corner : triangle)
        points += view.at(mesh.points[static_cast<std::size_t>(corner)]) + ' ';
      text += fmt::format(
          "<polygon points=\"{}\" fill=\"#d9d2c3\" stroke=\"#d9d2c3\" stroke-width=\"0.5\"/>\n", points);
    }
    for (const PolyhedronEdge& edge : block.solid().edges())
      text +=
          fmt::format("<polyline points=\"{} {}\" stroke=\"#8a8271\" stroke-width=\"0.7\" fill=\"none\"/>\n",
                      view.at(mesh.points[static_cast<std::size_t>(edge.vertices[0])]),
                      view.at(mesh.points[static_cast<std::size_t>(edge.vertices[1])]));
  }
  const SupportThrust& support = findings.supports.front();
  text += drawn_line(support.least, simulation, view, "#1f5fa8");
  if (support.most) text += drawn_line(*support.most, simulation, view, "#b3261e");
  text += fmt::format(
      "<text x=\"{0}\" y=\"{1:.0f}\" font-family=\"sans-serif\" font-size=\"14\"><tspan "
      "fill=\"#1f5fa8\">least thrust "
      "{2:.4g} N</tspan>",
      View::margin, view.height() + 20.0, support.least.thrust);
  if (support.most)
    text += fmt::format("<tspan dx=\"20\" fill=\"#b3261e\">most {:.4g} N</tspan>", support.most->thrust);
  text += "</text>\n</svg>\n";
  write_file_atomically(path, text, Durability::process);
}

}  // namespace ashlar
