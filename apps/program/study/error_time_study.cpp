#include "apps/program/study/error_time_study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "apps/program/study/error_time_problems.hpp"
#include "apps/program/study/orders_study.hpp"
#include "apps/program/verify/verification_contacts.hpp"
#include "apps/results/system/this_process.hpp"
#include "solver/run/checkpoint.hpp"

namespace ashlar {
namespace {

constexpr std::array<const char*, 10> problem_names = {
    "incline", "swelling", "tumbling", "cantilever", "plate", "sphere", "rocking", "bars", "arch", "sliding"};
constexpr std::array<const char*, 3> integrator_names = {"dda", "average", "alpha"};

SimulationSettings settings_of(const ErrorTimeSetting& setting, const Vector3& gravity) {
  SimulationSettings settings;
  settings.gravity = gravity;
  settings.integrator = setting.integrator;
  settings.time_step = setting.time_step;
  return settings;
}

BlockDefinition block_of(const ErrorTimeSetting& setting, Polyhedron solid, const Material& material) {
  BlockDefinition block = define_block(std::move(solid), material, setting.order);
  if (setting.incremental) block.formulation = Formulation::incremental;
  return block;
}

double incline_error(const ErrorTimeSetting& setting) {
  constexpr double gravity = 10.0;
  constexpr double time = 0.4;
  constexpr double angle = std::numbers::pi / 6.0;
  ContactScene scene;
  scene.settings = settings_of(setting, {gravity * std::sin(angle), 0, -gravity * std::cos(angle)});
  *scene.law = {1e9, 1e9, tangent_of(20.0), 0.0, 0.0, !setting.incremental};
  if (setting.incremental) scene.settings.curved_surface = false;
  scene.settings.augmented = scene.law->rigid = !setting.springs;
  scene.add_fixed(Polyhedron(make_box({-2, -2, -1}, {6, 2, 0})));
  const int cube =
      scene.add(block_of(setting, Polyhedron(make_box({-0.5, -0.5, 0}, {0.5, 0.5, 1})), {2000, 1e8, 0.2}));
  Simulation simulation = scene.build();
  const Vector3 start = centroid(simulation, cube);
  if (!runs_to(simulation, time, setting)) return failed_run;
  const double distance =
      0.5 * gravity * time * time * (std::sin(angle) - tangent_of(20.0) * std::cos(angle));
  return std::abs((centroid(simulation, cube) - start).norm() / distance - 1.0);
}

/// A cube that swells by 1 + e has the energy 9/2 B e^2, with its bulk modulus B, and the inertia rho / 4 for e.
double swelling_error(const ErrorTimeSetting& setting) {
  const Material material{2000, 1e8, 0.25};
  const double bulk = material.young_modulus / (3.0 * (1.0 - 2.0 * material.poisson_ratio));
  const double frequency = std::sqrt(36.0 * bulk / material.density);
  const double period = 2.0 * std::numbers::pi / frequency;
  ErrorTimeSetting run = setting;
  run.time_step *= period;
  Simulation simulation =
      lone_block(block_of(run, Polyhedron(make_box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5})), material), {},
                 settings_of(run, Vector3::Zero()));
  constexpr double amplitude = 1e-4;
  const Eigen::MatrixX3d field = simulation.states()[0].position;
  SimulationSnapshot snapshot = simulation.snapshot();
  snapshot.run.states[0].velocity = amplitude * frequency * field;
  simulation.restore(snapshot);
  if (!runs_to(simulation, 5.0 * period, setting)) return failed_run;
  const PointMotion corner = simulation.blocks()[0].motion_of(simulation.states()[0], {0.5, 0.5, 0.5});
  const double strain = corner.displacement.x() / 0.5 / amplitude;
  const double rate = corner.velocity.x() / 0.5 / (amplitude * frequency);
  return std::hypot(strain, rate - 1.0);
}

const Vector3 half_sides(0.5, 1.0, 1.5);
const Vector3 tumble(0.01, 2.0, 0.02);
constexpr double tumbling_time = 5.0;

/// R' = R [w]x and I w' = (I w) x w in the frame of the body. @return R at the end
Eigen::Matrix3d tumbled() {
  using State = Eigen::Matrix<double, 3, 4>;
  const Vector3 squares = half_sides.cwiseAbs2();
  const Vector3 moments = Vector3::Constant(squares.sum()) - squares;
  const auto rate = [&](const State& at) {
    const Vector3 w = at.col(3);
    Eigen::Matrix3d cross;
    for (int axis = 0; axis < 3; ++axis) cross.col(axis) = w.cross(Vector3::Unit(axis));
    State result;
    result << at.leftCols<3>() * cross, moments.cwiseProduct(w).cross(w).cwiseQuotient(moments);
    return result;
  };
  State state;
  state << Eigen::Matrix3d::Identity(), tumble;
  constexpr double h = 1e-4;
  const int count = static_cast<int>(std::lround(tumbling_time / h));
  for (int k = 0; k < count; ++k) {
    const State k1 = rate(state);
    const State k2 = rate(state + 0.5 * h * k1);
    const State k3 = rate(state + 0.5 * h * k2);
    const State k4 = rate(state + h * k3);
    state += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return state.leftCols<3>();
}

double tumbling_error(const ErrorTimeSetting& setting) {
  static const Eigen::Matrix3d reference = tumbled();
  BlockDefinition box = block_of(setting, Polyhedron(make_box(-half_sides, half_sides)), {2000, 1e9, 0.2});
  for (int axis = 0; axis < 3; ++axis) box.followed.emplace_back(half_sides[axis] * Vector3::Unit(axis));
  Simulation simulation =
      lone_block(std::move(box), {Vector3::Zero(), tumble}, settings_of(setting, Vector3::Zero()));
  if (!runs_to(simulation, tumbling_time, setting)) return failed_run;
  Eigen::Matrix3d turn;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 corner = half_sides[axis] * Vector3::Unit(axis);
    turn.col(axis) =
        simulation.blocks()[0].motion_of(simulation.states()[0], corner).place / half_sides[axis];
  }
  return (turn - reference).norm();
}

/// True if orders are compared, not steps.
bool is_static(int problem) {
  return (problem >= 4 && problem <= 6) || problem == 9;
}

/// Adds runs to the table and the picture.
class ErrorTimeCurves {
 public:
  ErrorTimeCurves(const ErrorTimeStudySize& size, StudyResult& result) : size_(size), result_(result) {}

  void start(int problem, const std::string& name) {
    problem_ = problem;
    result_.plot.series.push_back(
        {fmt::format("{}: {}", problem_names.at(static_cast<std::size_t>(problem - 1)), name),
         {},
         {},
         problem % 2 == 0,
         false});
  }

  void add(ErrorTimeSetting setting, const std::function<double(const ErrorTimeSetting&)>& error_of) {
    double error = failed_run, estimate = 0.0;
    setting.estimate = &estimate;
    double seconds = std::numeric_limits<double>::infinity();
    for (int k = 0; k < size_.repeats; ++k) {
      const double start = processor_time();
      error = error_of(setting);
      seconds = std::min(seconds, processor_time() - start);
    }
    result_.plot.series.back().x.push_back(seconds);
    result_.plot.series.back().y.push_back(error);
    result_.rows.push_back({static_cast<double>(problem_), static_cast<double>(result_.plot.series.size()),
                            static_cast<double>(setting.order), static_cast<double>(setting.integrator),
                            setting.springs ? 1.0 : 0.0, setting.incremental ? 1.0 : 0.0, setting.time_step,
                            error, seconds, 0.0, setting.accuracy, estimate});
  }

  /// @param coarsest step, in the problem's unit
  void over_steps(int problem, ErrorTimeSetting setting, double coarsest,
                  const std::function<double(const ErrorTimeSetting&)>& error_of) {
    start(problem, setting.incremental
                       ? "the paper's"
                       : fmt::format("order {}, {}{}", setting.order,
                                     integrator_names.at(static_cast<std::size_t>(setting.integrator)),
                                     setting.springs ? ", springs" : ""));
    setting.time_step = coarsest;
    for (int k = 0; k < size_.steps; ++k, setting.time_step *= 0.5) add(setting, error_of);
  }

  /// Runs whose step, or in statics the order, is chosen.
  void over_accuracies(int problem, ErrorTimeSetting setting,
                       const std::function<double(const ErrorTimeSetting&)>& error_of, int most = 4) {
    start(problem, is_static(problem)
                       ? "chosen order"
                       : fmt::format("chosen step, order {}, {}", setting.order,
                                     integrator_names.at(static_cast<std::size_t>(setting.integrator))));
    setting.accuracy = 0.1;
    for (int k = 0; k < std::min(size_.accuracies, most); ++k, setting.accuracy *= 0.1)
      add(setting, error_of);
  }

 private:
  const ErrorTimeStudySize& size_;
  StudyResult& result_;
  int problem_ = 0;
};

enum TableColumn : std::size_t {
  of_problem,
  of_curve,
  of_order,
  of_integrator,
  of_springs,
  of_form,
  of_step,
  of_error,
  of_seconds,
  of_front,
  of_accuracy,
  of_estimate
};

/// Marks the runs without a faster and more accurate one. @return a sentence for each problem
std::vector<std::string> find_fronts(StudyResult& result) {
  std::vector<std::string> sentences;
  for (int problem = 1; problem <= static_cast<int>(problem_names.size()); ++problem) {
    std::vector<std::vector<double>*> rows;
    for (auto& row : result.rows)
      if (row[of_problem] == problem && std::isfinite(row[of_error])) rows.push_back(&row);
    std::sort(rows.begin(), rows.end(),
              [](const auto* a, const auto* b) { return (*a)[of_seconds] < (*b)[of_seconds]; });
    double least = std::numeric_limits<double>::infinity();
    std::vector<std::string> front;
    for (auto* row : rows) {
      if ((*row)[of_error] >= least) continue;
      least = (*row)[of_error];
      (*row)[of_front] = 1.0;
      const double step = (*row)[of_step];
      const std::string& curve = result.plot.series[static_cast<std::size_t>((*row)[of_curve]) - 1].name;
      const std::string chosen = (*row)[of_accuracy] > 0.0 ? fmt::format("asked {:.0e}", (*row)[of_accuracy])
                                 : is_static(problem)      ? fmt::format("order {}", (*row)[of_order])
                                                           : fmt::format("step {:.3g}{}", step,
                                                                    problem == 2   ? " periods"
                                                                         : problem == 8 ? " durations"
                                                                                        : " s");
      front.push_back(
          fmt::format("{}, {}: {:.1e} in {:.2g} ms", curve, chosen, least, 1e3 * (*row)[of_seconds]));
    }
    if (rows.empty()) continue;
    sentences.push_back(fmt::format("Nothing faster has less error: {}.", fmt::join(front, "; ")));
  }
  return sentences;
}

/// A problem whose step or order is chosen.
struct AskedProblem {
  int problem;
  int order;
  Integrator integrator;
  double (*error_of)(const ErrorTimeSetting&);
};
constexpr std::array<AskedProblem, 6> asked_problems = {
    {{1, 0, Integrator::dda, incline_error},
     {1, 0, Integrator::average_acceleration, incline_error},
     {2, 1, Integrator::average_acceleration, swelling_error},
     {2, 1, Integrator::generalized_alpha, swelling_error},
     {3, 0, Integrator::average_acceleration, tumbling_error},
     {4, 1, Integrator::dda, cantilever_error}}};

/// Compares runs with a chosen step or order with what was asked, and with the fastest of the given ones that has it.
std::vector<std::string> compare_chosen(StudyResult& result) {
  std::vector<std::string> sentences;
  for (const auto& row : result.rows) {
    const double asked = row[of_accuracy];
    if (asked == 0.0) continue;
    double fastest = std::numeric_limits<double>::infinity();
    for (const auto& other : result.rows)
      if (other[of_accuracy] == 0.0 && other[of_problem] == row[of_problem] && other[of_error] <= asked)
        fastest = std::min(fastest, other[of_seconds]);
    const std::string& curve = result.plot.series[static_cast<std::size_t>(row[of_curve]) - 1].name;
    const std::string cost = std::isfinite(fastest) ? fmt::format("{:.2g} times the fastest given choice",
                                                                  row[of_seconds] / fastest)
                                                    : "no given choice has it";
    sentences.push_back(fmt::format("{}: asked {:.0e}, error {:.1e}, told {:.1e}, {}", curve, asked,
                                    row[of_error], row[of_estimate], cost));
    constexpr double most = 3.0;
    result.holds = result.holds && row[of_error] <= most * std::max(asked, row[of_estimate]);
  }
  return sentences;
}

}  // namespace

std::vector<ChosenRun> chosen_runs(int accuracies) {
  std::vector<ChosenRun> runs;
  for (const AskedProblem& asked : asked_problems) {
    ErrorTimeSetting setting{asked.order, asked.integrator};
    setting.accuracy = 0.1;
    const std::string name(problem_names.at(static_cast<std::size_t>(asked.problem - 1)));
    const char* scheme = integrator_names.at(static_cast<std::size_t>(asked.integrator));
    for (int k = 0; k < accuracies; ++k, setting.accuracy *= 0.1) {
      double estimate = 0.0;
      setting.estimate = &estimate;
      const double error = asked.error_of(setting);
      runs.push_back({asked.problem == 4 ? name : fmt::format("{}, {}", name, scheme), setting.accuracy,
                      error, estimate});
    }
  }
  return runs;
}

StudyResult study_error_time() {
  return study_error_time(ErrorTimeStudySize{});
}

namespace {

/// Adds the curves of error_time_problems.hpp.
void add_further_problems(const ErrorTimeStudySize& size, ErrorTimeCurves& curves) {
  curves.start(5, "one block");
  for (int order = 1; order <= std::min(8, 4 * size.steps); ++order) curves.add({order}, plate_error);
  curves.over_accuracies(5, {}, plate_error, 2);
  curves.start(6, "graded tied blocks");
  for (int order = 1; order <= std::min(3, size.steps - 1); ++order) curves.add({order}, sphere_error);
  if (size.steps > 2) curves.over_accuracies(6, {}, sphere_error, 1);
  for (const Integrator integrator : {Integrator::dda, Integrator::generalized_alpha})
    curves.over_steps(7, {1, integrator, true}, 4e-3, rocking_error);
  for (const Integrator integrator : {Integrator::dda, Integrator::generalized_alpha})
    curves.over_steps(8, {3, integrator, true}, 1.0 / 12.5, bar_impact_error);
  curves.over_accuracies(7, {1, Integrator::generalized_alpha, true}, rocking_error, 3);
  curves.over_accuracies(8, {3, Integrator::generalized_alpha, true}, bar_impact_error, 2);
  for (const Integrator integrator : {Integrator::dda, Integrator::average_acceleration})
    curves.over_steps(10, {0, integrator}, 0.04, sliding_error);
  curves.over_accuracies(10, {0, Integrator::average_acceleration}, sliding_error);
}

/// @return a sentence about the reference; empty: the arch is left out
std::string add_arch(const ErrorTimeStudySize& size, ErrorTimeCurves& curves) {
  if (size.steps <= 2) return {};
  const ArchReference reference = arch_reference();
  curves.start(9, "voussoirs of one order");
  for (int order = 1; order <= 4; ++order) curves.add({order}, arch_error);
  curves.over_accuracies(9, {}, arch_error, 2);
  return fmt::format(
      "arch: no closed form; errors are relative to this program's own orders 6, which sink "
      "{:.4g} mm at the crown, {:.1e} from orders 5: smaller errors mean nothing",
      1e3 * reference.sinking, reference.error);
}

}  // namespace

StudyResult study_error_time(const ErrorTimeStudySize& size) {
  StudyResult result;
  result.columns = {"problem",   "curve", "order",   "integrator", "springs",  "incremental",
                    "time_step", "error", "seconds", "front",      "accuracy", "estimate"};
  result.plot = {"Error of motion against run time", "seconds", "error", {}};
  result.plot.slopes = false;
  ErrorTimeCurves curves(size, result);
  const std::array<Integrator, 3> integrators = {Integrator::dda, Integrator::average_acceleration,
                                                 Integrator::generalized_alpha};
  for (const int order : {0, 1}) {
    for (const Integrator integrator : integrators) {
      if (order == 0 && integrator == Integrator::generalized_alpha) continue;
      curves.over_steps(1, {order, integrator}, 0.016, incline_error);
    }
  }
  curves.over_steps(1, {1, Integrator::dda, true}, 0.016, incline_error);
  curves.over_steps(1, {1, Integrator::dda, true, true}, 0.016, incline_error);
  for (const Integrator integrator : integrators)
    curves.over_steps(2, {1, integrator}, 1.0 / 16.0, swelling_error);
  curves.over_steps(2, {1, Integrator::dda, true, true}, 1.0 / 16.0, swelling_error);
  for (const int order : {0, 1}) {
    for (const Integrator integrator : integrators) {
      if (order == 0 && integrator == Integrator::generalized_alpha) continue;
      curves.over_steps(3, {order, integrator}, 0.04, tumbling_error);
    }
  }
  curves.over_steps(3, {1, Integrator::dda, true, true}, 0.04, tumbling_error);
  curves.start(4, "one block");
  for (int order = 1; order <= 8; ++order) curves.add({order}, cantilever_error);
  for (const AskedProblem& asked : asked_problems)
    curves.over_accuracies(asked.problem, {asked.order, asked.integrator}, asked.error_of);
  add_further_problems(size, curves);
  const std::string about_arch = add_arch(size, curves);
  result.findings = find_fronts(result);
  if (!about_arch.empty()) result.findings.push_back(about_arch);
  for (std::string& sentence : compare_chosen(result)) result.findings.push_back(std::move(sentence));
  // Deformable blocks stretch as they rotate: they converge to another motion, which differs by 2e-4.
  for (const PlotSeries& series : result.plot.series) {
    if (series.name.starts_with("tumbling: order 0"))
      result.holds = result.holds && series.y.back() < 0.5 * series.y.front();
  }
  result.findings.emplace_back(
      "What to choose: order 0 where blocks slide, turn and topple and their deformation does not matter; "
      "order 1 to 3 where forces go through many blocks; more for one block that bends. dda where contacts "
      "open and close, average-acceleration where vibrations are to last. Halve the step, or raise the "
      "order, until what is asked for stays.");
  return result;
}

}  // namespace ashlar
