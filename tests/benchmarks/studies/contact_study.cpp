#include "benchmarks/studies/contact_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>

#include "apps/program/verify/falling_block.hpp"
#include "apps/program/verify/hertz_sphere.hpp"
#include "apps/program/verify/verification_contacts.hpp"
#include "benchmarks/studies/patch_test.hpp"

namespace ashlar {
namespace {

/// Smallest error in the picture: exact settings would otherwise compress all others.
constexpr double least_drawn = 1e-5;

/// Settings of a run.
struct ContactSetting {
  Formulation formulation = Formulation::total;
  bool area_springs = true;
  bool curved_surface = true;
  int levels = 1;
  double stiffness = 0.0;
  double time_step = 0.0;
};

/// The paper's.
ContactSetting papers_own(ContactSetting setting) {
  setting.formulation = Formulation::incremental;
  setting.area_springs = false;
  setting.curved_surface = false;
  return setting;
}

/// Adds runs to the table and the picture.
class ContactCurves {
 public:
  explicit ContactCurves(StudyResult& result) : result_(result) {}

  void start(int problem, std::string name, bool dashed = false) {
    problem_ = problem;
    result_.plot.series.push_back({std::move(name), {}, {}, dashed, false});
  }

  /// @param error_of runs and returns the error. @return that error
  double add(const ContactSetting& setting, const std::function<double(const ContactSetting&)>& error_of) {
    const auto start = std::chrono::steady_clock::now();
    const double error = error_of(setting);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    result_.plot.series.back().x.push_back(seconds);
    result_.plot.series.back().y.push_back(std::max(error, least_drawn));
    const auto flag = [](bool value) { return value ? 1.0 : 0.0; };
    result_.rows.push_back({static_cast<double>(problem_), static_cast<double>(result_.plot.series.size()),
                            flag(setting.formulation == Formulation::incremental),
                            flag(!setting.area_springs), flag(!setting.curved_surface),
                            static_cast<double>(setting.levels), setting.stiffness, setting.time_step, error,
                            seconds});
    return error;
  }

 private:
  StudyResult& result_;
  int problem_ = 0;
};

double patch_error(const ContactSetting& setting) {
  PatchTest patch;
  patch.order = 3;
  patch.formulation = setting.formulation;
  patch.area_springs = setting.area_springs;
  patch.curved_surface = setting.curved_surface;
  patch.subdivisions = setting.levels;
  patch.stiffness = setting.stiffness;
  return press(patch).jump;
}

/// @return largest error with area springs
double study_patch(int levels, ContactCurves& curves) {
  ContactSetting setting;
  setting.stiffness = 1e9;
  double worst = 0.0;
  const auto over_levels = [&](const char* name, const ContactSetting& with) {
    curves.start(1, name);
    double largest = 0.0;
    for (int level = 0; level <= levels; ++level) {
      ContactSetting run = with;
      run.levels = level;
      largest = std::max(largest, curves.add(run, patch_error));
    }
    return largest;
  };
  worst = std::max(worst, over_levels("patch: area, curved", setting));
  setting.curved_surface = false;
  worst = std::max(worst, over_levels("patch: area, flat", setting));
  setting.area_springs = false;
  over_levels("patch: point, flat", setting);
  setting.levels = 1;
  curves.start(1, "patch: incremental, point, flat");
  for (int level = 0; level <= std::min(levels, 1); ++level) {
    ContactSetting run = papers_own(setting);
    run.levels = level;
    curves.add(run, patch_error);
  }
  return worst;
}

double hertz_error(const ContactSetting& setting) {
  HertzSphere sphere;
  sphere.near_order = 4;
  sphere.facets = setting.levels;
  sphere.stiffness = setting.stiffness;
  sphere.area_springs = setting.area_springs;
  sphere.curved_surface = setting.curved_surface;
  const HertzContact contact = press(sphere);
  if (!contact.equilibrium) return failed_run;
  return std::max({std::abs(contact.radius / sphere.contact_radius() - 1.0),
                   std::abs(contact.approach / sphere.approach() - 1.0),
                   std::abs(contact.peak_pressure / sphere.peak_pressure() - 1.0)});
}

void study_hertz(ContactCurves& curves) {
  ContactSetting setting;
  const auto over = [&](const char* name, const ContactSetting& with) {
    curves.start(2, name);
    for (const int facets : {2, 4, 6}) {
      ContactSetting run = with;
      run.levels = facets;
      curves.add(run, hertz_error);
    }
  };
  setting.stiffness = 2e15;
  over("Hertz: area, curved", setting);
  setting.curved_surface = false;
  over("Hertz: area, flat", setting);
  setting.area_springs = false;
  over("Hertz: point, flat", setting);
  setting = {};
  setting.levels = 4;
  curves.start(2, "Hertz: area, curved, kn", true);
  for (const double stiffness : {2.5e14, 5e14, 1e15}) {
    setting.stiffness = stiffness;
    curves.add(setting, hertz_error);
  }
}

/// Starts just above the cantilever at the speed of the fall, and runs until the tip has come up again.
double deepest_tip(const ContactSetting& setting) {
  FallingBlock example;
  example.drop = 0.01;
  example.speed = std::sqrt(2.0 * 9.81 * (1.0 - example.drop));
  example.formulation = setting.formulation;
  example.area_springs = setting.area_springs;
  example.curved_surface = setting.curved_surface;
  example.subdivisions = setting.levels;
  example.chord_tolerance = std::numeric_limits<double>::infinity();
  example.stiffness = setting.stiffness;
  // The errors of coarse sub-faces, point springs and the paper's formulation are the subject of the measurement.
  example.allowed_depth = 1.0;
  example.time_step = setting.time_step;
  Simulation simulation = falling_block(example);
  double deepest = 0.0;
  while (!simulation.reached(0.65)) {
    if (simulation.step(0.65) != StepStatus::accepted) return failed_run;
    const Vector3 motion =
        simulation.blocks()[1].motion_of(simulation.states()[1], falling_block_tip()).displacement;
    deepest = std::min(deepest, motion.z());
  }
  return deepest;
}

/// @return errors of the finest steps: of these settings, and of the paper's
std::array<double, 2> study_falling_block(const ContactStudySize& size, ContactCurves& curves) {
  ContactSetting setting;
  setting.stiffness = 5e10;
  setting.time_step = size.reference_step;
  const double reference = deepest_tip(setting);
  const auto error_of = [reference](const ContactSetting& run) {
    return std::abs(deepest_tip(run) / reference - 1.0);
  };
  const auto over_steps = [&](const char* name, ContactSetting with, double finest) {
    curves.start(3, name);
    double error = failed_run;
    with.time_step = 2e-3;
    while (with.time_step > 0.9 * finest) {
      error = curves.add(with, error_of);
      with.time_step *= 0.5;
    }
    return error;
  };
  const double ours = over_steps("block: area, curved, dt", setting, size.finest_step);
  const double papers =
      over_steps("block: incremental, point, flat, dt", papers_own(setting), 2.0 * size.finest_step);
  const auto over_levels = [&](const char* name, ContactSetting with) {
    curves.start(3, name, true);
    with.time_step = size.finest_step;
    for (int level = 0; level <= size.falling_levels; ++level) {
      with.levels = level;
      curves.add(with, error_of);
    }
  };
  over_levels("block: area, curved, sub-faces", setting);
  ContactSetting flat = setting;
  flat.curved_surface = false;
  over_levels("block: area, flat, sub-faces", flat);
  flat.area_springs = false;
  over_levels("block: point, flat, sub-faces", flat);
  curves.start(3, "block: area, curved, kn", true);
  setting.time_step = size.finest_step;
  for (const double stiffness : {5e8, 5e9, 5e11}) {
    setting.stiffness = stiffness;
    curves.add(setting, error_of);
  }
  return {ours, papers};
}

}  // namespace

StudyResult study_contact() {
  return study_contact(ContactStudySize{});
}

StudyResult study_contact(const ContactStudySize& size) {
  constexpr double promised_patch = 1e-9;
  StudyResult result;
  result.columns = {"problem", "curve",     "incremental", "point", "flat",
                    "levels",  "stiffness", "time_step",   "error", "seconds"};
  result.plot = {"Error of contact against run time", "seconds", "relative error (exact: at 1e-5)", {}};
  result.plot.slopes = false;
  ContactCurves curves(result);
  const double patch = study_patch(size.patch_levels, curves);
  if (size.hertz) study_hertz(curves);
  const auto [ours, papers] = study_falling_block(size, curves);
  result.findings.push_back(
      fmt::format("Problem 1, the contact patch: area springs give the exact jump within {:.1e} (promised: "
                  "{:.0e}) however faces are divided. Point springs do not: each division adds points, and "
                  "each point its stiffness.",
                  patch, promised_patch));
  if (size.hertz) {
    result.findings.push_back(
        "Problem 2, Hertz: levels are facets along a side of the block with the contact patch.");
  }
  result.findings.push_back(fmt::format(
      "Problem 3, the falling block, is compared with its own run at steps of {} s. At {} s the "
      "tip is {:.2f} % off; with the paper's settings, at {} s, {:.2f} %.",
      size.reference_step, size.finest_step, 100.0 * ours, 2.0 * size.finest_step, 100.0 * papers));
  result.holds = patch <= promised_patch;
  return result;
}

}  // namespace ashlar
