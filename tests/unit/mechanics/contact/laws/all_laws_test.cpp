// Every law of a joint: derivatives of its forces, and energy of a step.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mechanics/contact/laws/joint_law.hpp"
#include "support/check_derivatives.hpp"

namespace ashlar::all_laws_test {
namespace {

constexpr double area = 0.1;  // m^2

struct NamedLaw {
  const char* name;
  JointLaw law;
  bool is_static = false;
};
void PrintTo(const NamedLaw& of, std::ostream* out) {
  *out << of.name;
}

/// kn = 2e9, ks = 1e9 Pa/m, tan(phi) = 0.6.
JointLaw coulomb() {
  return {2e9, 1e9, 0.6};
}

std::vector<NamedLaw> all_laws() {
  std::vector<NamedLaw> laws = {{"smooth", {2e9, 1e9, 0.0}}, {"Coulomb", coulomb()}};
  const auto add = [&](const char* name, auto change) {
    laws.push_back({name, coulomb()});
    change(laws.back().law);
  };
  add("cohesion", [](JointLaw& law) { law.cohesion = 2e4; });
  add("brittle", [](JointLaw& law) {
    law.cohesion = 2e4;
    law.tensile_strength = 1e4;
  });
  add("plastic", [](JointLaw& law) {
    law.cohesion = 2e4;
    law.tensile_strength = 1e4;
    law.residual = ResidualStrength{0.6, 2e4, 1e4};
  });
  laws.push_back(laws.back());
  laws.back().name = "plastic in statics";
  laws.back().is_static = true;
  add("dilation", [](JointLaw& law) { law.dilation = 0.2; });
  add("softening", [](JointLaw& law) {
    law.cohesion = 2e4;
    law.tensile_strength = 1e4;
    law.fracture = {0.5, 2.0};
  });
  add("crushing", [](JointLaw& law) { law.compressive_strength = 6e4; });
  add("rough", [](JointLaw& law) { law.roughness = {10.0, 3e6, law.friction}; });
  add("rough with dilation", [](JointLaw& law) {
    law.roughness = {10.0, 3e6, law.friction};
    law.dilation = 0.2;
  });
  // At 40 um the force is five times that of a linear spring.
  add("closing", [](JointLaw& law) { law.largest_closure = 5e-5; });
  add("closing with cohesion", [](JointLaw& law) {
    law.largest_closure = 5e-5;
    law.cohesion = 2e4;
  });
  add("closing and rough", [](JointLaw& law) {
    law.largest_closure = 5e-5;
    law.roughness = {10.0, 3e6, law.friction};
  });
  add("closing with dilation", [](JointLaw& law) {
    law.largest_closure = 5e-5;
    law.dilation = 0.2;
  });
  return laws;
}

PointLaw point_of(const NamedLaw& of) {
  PointLaw point = point_law(of.law, area, true);
  point.is_static = of.is_static;
  return point;
}

/// Gaps of 40 um at most, 80 kPa, and slips of 200 um, 200 kPa.
Eigen::Vector3d random_place(std::mt19937& random) {
  std::uniform_real_distribution<double> gap(-4e-5, 1e-5), slip(-2e-4, 2e-4);
  const double first = gap(random), second = slip(random), third = slip(random);
  return {first, second, third};
}

/// Random steps of a point, each from where the one before has left it. Open points dilate from their landing on.
class RandomHistory {
 public:
  RandomHistory(const PointLaw& law, unsigned seed) : law(law), random_(seed) {}
  /// Takes the next step. Its end is relative to the rest gap and slip at its start.
  AveragedStep next() {
    law.dilation.landing_from = 0.0;
    start = point_response(law, from[0], from.tail<2>());
    if (start.state == ContactState::open) law.dilation.landing_from = from[0];
    std::uniform_real_distribution<double> gap(-2.5e-5, 1e-5), slip(-1e-4, 1e-4);
    to = Eigen::Vector3d(gap(random_), from[1], from[2]);
    to[1] += slip(random_);
    to[2] += slip(random_);
    return averaged_step(law, start, from, to);
  }
  /// Goes on to the end of a step, or begins anew where strength has been lost.
  void accept(const AveragedStep& step) {
    if ((law.tension > 0.0 && parts(step)) || step.end.damage >= 1.0) {
      from = Eigen::Vector3d(-1e-5, 0.0, 0.0);
      law.set_damage(0.0);
      return;
    }
    from << to[0] - step.end.dilation, elastic_slip(law, step.end, to.tail<2>());
    law.set_damage(step.end.damage);
  }
  [[nodiscard]] bool parts(const AveragedStep& step) const {
    return start.state != ContactState::open && step.end.state == ContactState::open;
  }

  PointLaw law;
  Eigen::Vector3d from{-1e-5, 0.0, 0.0}, to{-1e-5, 0.0, 0.0};
  PointResponse start{};

 private:
  std::mt19937 random_;
};

class AllLaws : public ::testing::TestWithParam<NamedLaw> {};

TEST_P(AllLaws, TangentAndCouplingAreTheDerivativeOfTheForceAtTheEnd) {
  const PointLaw point = point_of(GetParam());
  std::mt19937 random(1);
  for (int k = 0; k < 200; ++k) {
    const Eigen::Vector3d place = random_place(random);
    const PointResponse end = point_response(point, place[0], place.tail<2>());
    test_support::expect_derivative(
        [&](const Eigen::VectorXd& at) -> Eigen::VectorXd {
          return -point_response(point, at[0], at.tail<2>()).force;
        },
        place, end.tangent + end.coupling.force * end.coupling.by.transpose(), 1e-11, 1e-5);
  }
}

TEST_P(AllLaws, TangentAndCouplingAreTheDerivativeOfTheMeanForce) {
  if (GetParam().is_static) GTEST_SKIP() << "statics has the force at the end";
  if (GetParam().law.fracture.given()) GTEST_SKIP() << "secants in place of tangents (softened_point.hpp)";
  RandomHistory history(point_of(GetParam()), 2);
  for (int k = 0; k < 300; ++k) {
    const AveragedStep step = history.next();
    // Points that part, or that dilation alone keeps closed, have forces over a share of the step, whose derivative by
    // slip is left out.
    const bool rises = history.law.dilation.tangent > 0.0 && history.to[0] > 0.0;
    if (!history.parts(step) && !rises) {
      test_support::expect_derivative(
          [&](const Eigen::VectorXd& at) -> Eigen::VectorXd {
            return -averaged_step(history.law, history.start, history.from, at).mean.force;
          },
          history.to, step.mean.tangent + step.mean.coupling.force * step.mean.coupling.by.transpose(), 1e-11,
          1e-5);
    }
    history.accept(step);
  }
}

TEST_P(AllLaws, AStepGainsNoEnergy) {
  if (GetParam().is_static) GTEST_SKIP() << "statics has the force at the end";
  if (GetParam().law.fracture.given()) GTEST_SKIP() << "softened_point_test has its fracture energy";
  RandomHistory history(point_of(GetParam()), 3);
  for (int k = 0; k < 1000; ++k) {
    const AveragedStep step = history.next();
    const double absorbed = -step.mean.force.dot(history.to - history.from);  // by the joint
    const double gained = step.end.energy() - history.start.energy();
    const double scale = std::abs(absorbed) + history.start.energy() + step.end.energy();
    EXPECT_GE(absorbed - gained, -1e-12 * scale)
        << "from " << history.from.transpose() << " to " << history.to.transpose();
    history.accept(step);
  }
}

INSTANTIATE_TEST_SUITE_P(Joints, AllLaws, ::testing::ValuesIn(all_laws()), [](const auto& of) {
  std::string name = of.param.name;
  for (char& letter : name)
    if (letter == ' ') letter = '_';
  return name;
});

}  // namespace
}  // namespace ashlar::all_laws_test
