#include "apps/run/answers/kinematic_check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "apps/results/text/csv_text.hpp"
#include "apps/run/answers/elastic_spectrum.hpp"
#include "geometry/exact/rounded_functions.hpp"

namespace ashlar {
namespace {

/// Of an unknown strength of the masonry in compression: level of knowledge LC1.
constexpr double usual_confidence = 1.35;
constexpr double usual_behaviour = 2.0;
constexpr double ultimate_share = 0.4, secant_share = 0.4;

std::optional<KinematicCapacity> capacity_of(const Pushover& path, double confidence, double gravity) {
  double weight = 0.0, first = 0.0, second = 0.0;
  for (const PushedWeight& block : path.mechanism) {
    weight += block.weight;
    first += block.weight * block.displacement;
    second += block.weight * block.displacement * block.displacement;
  }
  if (path.places.empty() || !(first > 0.0) || !(second > 0.0)) return std::nullopt;
  KinematicCapacity capacity;
  capacity.multiplier = path.activation;
  capacity.weight = weight;
  capacity.mass = first * first / (gravity * second);
  // Blocks that move before the limit have another mechanism: the whole weight takes part, the safe side.
  if (!path.at_limit) capacity.mass = weight / gravity;
  capacity.mass_fraction = gravity * capacity.mass / weight;
  const double scale = gravity / (capacity.mass_fraction * confidence);
  capacity.acceleration = capacity.multiplier * scale;
  capacity.displacement_ratio = second / first;
  if (!path.zero || !path.at_limit) return capacity;
  capacity.zero = *path.zero;
  const double control = ultimate_share * *path.zero;
  capacity.ultimate = control * capacity.displacement_ratio;
  capacity.secant = secant_share * *capacity.ultimate;
  const std::optional<double> multiplier = multiplier_at(path, secant_share * control);
  if (!multiplier || !(*multiplier > 0.0)) return capacity;
  capacity.secant_acceleration = *multiplier * scale;
  capacity.secant_period =
      2.0 * std::numbers::pi * std::sqrt(*capacity.secant / *capacity.secant_acceleration);
  return capacity;
}

/// Amplification of displacement by a building, (11).
double resonance(double ratio) {
  return ratio * ratio / std::sqrt((1.0 - ratio) * (1.0 - ratio) + 0.02 * ratio);
}

KinematicDemand demand_of(const KinematicCapacity& capacity, const ScenePushover& asked,
                          const SceneSpectrum& spectrum, double behaviour) {
  KinematicDemand demand;
  demand.ground_acceleration = spectral_acceleration(spectrum, 0.0);
  demand.linear = KinematicVerdict{capacity.acceleration, demand.ground_acceleration / behaviour};
  if (capacity.secant_period)
    demand.nonlinear =
        KinematicVerdict{*capacity.ultimate, spectral_displacement(spectrum, *capacity.secant_period)};
  if (!asked.height || !asked.building_height) return demand;
  const double storeys = asked.storeys.value_or(1);
  demand.mode = *asked.height / *asked.building_height;
  demand.participation = 3.0 * storeys / (2.0 * storeys + 1.0);
  demand.building_period = asked.period.value_or(0.05 * correctly_rounded::pow(*asked.building_height, 0.75));
  const double amplified = demand.mode * demand.participation;
  demand.linear_above = KinematicVerdict{
      capacity.acceleration, spectral_acceleration(spectrum, demand.building_period) * amplified / behaviour};
  if (capacity.secant_period)
    demand.nonlinear_above = KinematicVerdict{
        *capacity.ultimate, spectral_displacement(spectrum, demand.building_period) * amplified *
                                resonance(*capacity.secant_period / demand.building_period)};
  return demand;
}

/// A table of numbers with their symbols.
class NumberTable {
 public:
  void add(const char* quantity, const char* symbol, const std::optional<double>& value, const char* unit,
           const char* equation) {
    text_ += std::string(quantity) + ',' + symbol + ',';
    if (value) append_csv_number(text_, *value);
    text_ += std::string(",") + unit + ',' + equation + '\n';
  }
  void add(const char* what, const char* unit, const std::optional<KinematicVerdict>& verdict,
           const char* equation) {
    if (!verdict) return;
    const std::string name = what;
    add((name + ": capacity").c_str(), "", verdict->capacity, unit, equation);
    add((name + ": demand").c_str(), "", verdict->demand, unit, equation);
    text_ += name + ": verdict,," + (verdict->satisfied() ? "satisfied" : "not satisfied") + ",," + equation +
             '\n';
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_ = "quantity,symbol,value,unit,equation\n";
};

}  // namespace

std::vector<double> shares_of_check() {
  return {secant_share * ultimate_share, ultimate_share};
}

std::optional<KinematicCheck> kinematic_check(const Pushover& path, const ScenePushover& asked,
                                              const SceneSpectrum& spectrum, double gravity) {
  KinematicCheck check;
  check.confidence_factor = asked.confidence_factor.value_or(usual_confidence);
  check.behaviour_factor = asked.behaviour_factor.value_or(usual_behaviour);
  const auto capacity = capacity_of(path, check.confidence_factor, gravity);
  if (!capacity) return std::nullopt;
  check.capacity = *capacity;
  if (spectrum.source != SceneSpectrum::Source::none)
    check.demand = demand_of(*capacity, asked, spectrum, check.behaviour_factor);
  return check;
}

std::string verdict_of(const KinematicCheck& check) {
  if (!check.demand) return "no demand";
  const KinematicDemand& demand = *check.demand;
  const bool displacements = demand.nonlinear.has_value();
  const auto& ground = displacements ? demand.nonlinear : demand.linear;
  const auto& above = displacements ? demand.nonlinear_above : demand.linear_above;
  return ground->satisfied() && (!above || above->satisfied()) ? "satisfied" : "not satisfied";
}

std::string kinematic_table(const KinematicCheck& check) {
  const KinematicCapacity& capacity = check.capacity;
  NumberTable table;
  table.add("multiplier of activation", "alpha_0", capacity.multiplier, "1", "");
  table.add("weight of the mechanism", "sum P_i", capacity.weight, "N", "");
  table.add("participating mass", "M*", capacity.mass, "kg", "1");
  table.add("mass fraction", "e*", capacity.mass_fraction, "1", "2");
  table.add("confidence factor", "FC", check.confidence_factor, "1", "");
  table.add("spectral acceleration of activation", "a0*", capacity.acceleration, "m/s^2", "3");
  table.add("displacement of the control at zero", "d_k0", capacity.zero, "m", "");
  table.add("spectral displacement per displacement of the control", "d*/d_k", capacity.displacement_ratio,
            "1", "4");
  table.add("ultimate displacement", "d_u*", capacity.ultimate, "m", "6");
  table.add("secant displacement", "d_s*", capacity.secant, "m", "7");
  table.add("acceleration there", "a_s*", capacity.secant_acceleration, "m/s^2", "5");
  table.add("secant period", "T_s", capacity.secant_period, "s", "7");
  if (!check.demand) return table.text();
  const KinematicDemand& demand = *check.demand;
  table.add("behaviour factor", "q", check.behaviour_factor, "1", "");
  table.add("acceleration of the ground", "Se(0)", demand.ground_acceleration, "m/s^2", "");
  if (demand.linear_above) {
    table.add("first period of the building", "T1", demand.building_period, "s", "");
    table.add("first mode at the height", "psi", demand.mode, "1", "");
    table.add("participation of the first mode", "gamma", demand.participation, "1", "");
  }
  table.add("linear on the ground", "m/s^2", demand.linear, "8");
  table.add("linear at the height", "m/s^2", demand.linear_above, "9");
  table.add("non-linear on the ground", "m", demand.nonlinear, "10");
  table.add("non-linear at the height", "m", demand.nonlinear_above, "11");
  return table.text();
}

}  // namespace ashlar
