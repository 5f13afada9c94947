#include "apps/python/core_simulation.hpp"

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "apps/python/core_scene.hpp"
#include "apps/results/tables/contact_state.hpp"
#include "apps/run/answers/answer_search.hpp"
#include "apps/run/run.hpp"
#include "geometry/index.hpp"

namespace py = pybind11;

namespace ashlar {
namespace {

/// @param values row by row, as many as the shape requires
py::array_t<double> array_of(std::vector<py::ssize_t> shape, const std::vector<double>& values) {
  return py::array_t<double>(std::move(shape), values.data());
}

py::array_t<double> array_of(const std::vector<Vector3>& rows) {
  std::vector<double> values;
  values.reserve(3 * rows.size());
  for (const Vector3& row : rows) values.insert(values.end(), {row.x(), row.y(), row.z()});
  return array_of({static_cast<py::ssize_t>(rows.size()), 3}, values);
}

using Points = py::array_t<double, py::array::c_style | py::array::forcecast>;

std::vector<Vector3> points_of(const py::object& given) {
  const py::array any = py::array::ensure(given);
  if (any && any.dtype().kind() == 'c') throw py::type_error("points are real numbers, not complex ones");
  const Points array = any ? Points::ensure(any) : Points();
  if (!array) throw py::type_error("points are an array of numbers");
  if (array.ndim() != 2 || array.shape(1) != 3) throw py::value_error("points are an array of shape (n, 3)");
  const auto values = array.unchecked<2>();
  std::vector<Vector3> points;
  for (py::ssize_t i = 0; i < array.shape(0); ++i)
    points.emplace_back(values(i, 0), values(i, 1), values(i, 2));
  return points;
}

/// One entry of contacts().
struct ContactRow {
  std::int32_t a, b;
  double place[3], normal[3], force[3];
  double gap, area;
  std::int32_t type, state;
};

/// @param origin Scene::origin
ContactRow row_of(const PairRecord& pair, std::size_t k, ContactState state, const Vector3& origin) {
  const ContactPoint& point = pair.points[k];
  const PointResponse& response = pair.responses[k];
  const Vector3 place = origin + 0.5 * (point.place_a + point.place_b);
  const Vector3 force = out_of_frame(point, response.force);
  ContactRow row{};
  row.a = pair.a;
  row.b = pair.b;
  for (int i = 0; i < 3; ++i) {
    row.place[i] = place[i];
    row.normal[i] = point.normal[i];
    row.force[i] = force[i];
  }
  row.gap = pair.gaps[k];
  row.area = point.area;
  row.type = static_cast<std::int32_t>(point.type);
  row.state = static_cast<std::int32_t>(state);
  return row;
}

/// A Run with numpy arrays. Calls from a thread wait for the step of another one.
class CoreSimulation {
 public:
  /// @param folder of the run that it continues; empty: a new run
  CoreSimulation(const CoreScene& scene, int threads, const std::optional<std::filesystem::path>& folder)
      : run_(scene.good(), threads) {
    if (folder) run_.resume(*folder);
    // Searches take long: they are stepped.
    if (!seeks_answer(run_.whole().analysis)) run_.begin();
    if (run_.status() == RunStatus::failed) throw std::runtime_error(run_.message());
  }

  /// Result of a function of the run. The interpreter lock is released while the thread waits, and during the
  /// function unless it makes Python objects.
  template <class Function>
  auto with_run(const Function& function) {
    std::unique_lock<std::mutex> access = wait();
    return function(run_);
  }
  template <class Function>
  auto without_interpreter(const Function& function) {
    const py::gil_scoped_release released;
    const std::lock_guard access(access_);
    return function(run_);
  }

  [[nodiscard]] py::dict history() {
    const std::unique_lock<std::mutex> access = wait();
    py::dict result;
    const std::vector<std::string> columns = run_.columns();
    for (std::size_t c = 0; c < columns.size(); ++c) {
      py::array_t<double> values(static_cast<py::ssize_t>(run_.rows().size()));
      auto cells = values.mutable_unchecked<1>();
      for (std::size_t r = 0; r < run_.rows().size(); ++r)
        cells(static_cast<py::ssize_t>(r)) = run_.rows()[r][c];
      result[py::str(columns[c])] = values;
    }
    return result;
  }

  /// Text of history.units.json.
  [[nodiscard]] std::string history_units() {
    const std::unique_lock<std::mutex> access = wait();
    return run_.column_units();
  }

  [[nodiscard]] py::array_t<ContactRow> contacts() {
    const std::vector<ContactRow> rows = without_interpreter([](const Run& run) {
      std::vector<ContactRow> found;
      for (const PairRecord& pair : run.simulation().contacts()) {
        const std::vector<ContactState> states = shown_states(run.simulation(), pair);
        for (std::size_t k = 0; k < pair.points.size(); ++k)
          found.push_back(row_of(pair, k, states[k], run.whole().origin));
      }
      return found;
    });
    return py::array_t<ContactRow>(static_cast<py::ssize_t>(rows.size()), rows.data());
  }

  /// Name, largest axial and shear force (N; nan: not installed) and state of each bolt and prop.
  [[nodiscard]] std::vector<std::tuple<std::string, double, double, std::string>> bolts() {
    return without_interpreter([](const Run& run) {
      std::vector<std::tuple<std::string, double, double, std::string>> rows;
      for (const Bolt& bolt : run.simulation().system().bolts()) {
        const BoltMeasure found = measured_bolt(
            run.simulation(), {.name = bolt.name, .kind = Measure::Kind::bolt, .bolt = bolt.name});
        rows.emplace_back(bolt.name, found.axial_force, found.shear_force, to_string(found.condition));
      }
      return rows;
    });
  }

  [[nodiscard]] int index_of(const std::string& name) {
    try {
      return with_run([&](const Run& run) { return run.block(name); });
    } catch (const std::out_of_range&) {
      throw py::key_error(name);
    }
  }

 private:
  [[nodiscard]] std::unique_lock<std::mutex> wait() {
    const py::gil_scoped_release released;
    return std::unique_lock<std::mutex>(access_);
  }

  Run run_;
  std::mutex access_;
};

/// A block of a simulation, by its number.
struct CoreBlock {
  std::shared_ptr<CoreSimulation> of;
  int index;

  /// Result of a function of the model, which is constant except for a block of the incremental formulation.
  template <class Function>
  [[nodiscard]] auto of_model(const Function& function) const {
    return of->with_run([&](const Run& run) { return function(run.simulation().blocks()[at(index)]); });
  }

  [[nodiscard]] std::vector<PointMotion> motions(const py::object& points, bool extrapolate) const {
    const std::vector<Vector3> places = points_of(points);
    const auto outside = extrapolate ? OutsidePoints::extrapolated : OutsidePoints::refused;
    return of->without_interpreter([&](const Run& run) { return run.motions(index, places, outside); });
  }

  /// @param part requested part of a point's motion. @return (n, 3)
  [[nodiscard]] py::array_t<double> vectors(const py::object& points, bool extrapolate,
                                            Vector3 PointMotion::*part) const {
    std::vector<Vector3> rows;
    for (const PointMotion& motion : motions(points, extrapolate)) rows.push_back(motion.*part);
    return array_of(rows);
  }

  [[nodiscard]] py::array_t<double> stress(const py::object& points, bool extrapolate) const {
    const std::vector<PointMotion> found = motions(points, extrapolate);
    std::vector<double> values;
    for (const PointMotion& motion : found)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) values.push_back(motion.stress(i, j));
    return array_of({static_cast<py::ssize_t>(found.size()), 3, 3}, values);
  }

  [[nodiscard]] py::array_t<double> coefficients() const {
    return array_of(of->with_run([&](const Run& run) {
      run.require_present(index);
      const Eigen::MatrixX3d& position = run.simulation().states()[at(index)].position;
      std::vector<Vector3> rows;
      for (Eigen::Index i = 0; i < position.rows(); ++i) rows.emplace_back(position.row(i).transpose());
      return rows;
    }));
  }

  [[nodiscard]] py::array_t<double> vertices() const {
    return array_of(of->with_run([&](const Run& run) {
      std::vector<Vector3> corners = run.simulation().blocks()[at(index)].solid().mesh().points;
      for (Vector3& corner : corners) corner += run.whole().origin;
      return corners;
    }));
  }

  [[nodiscard]] py::array_t<int> triangles() const {
    const auto triangles = of_model([](const BlockModel& block) { return block.solid().mesh().triangles; });
    py::array_t<int> array({static_cast<py::ssize_t>(triangles.size()), py::ssize_t{3}});
    auto values = array.mutable_unchecked<2>();
    for (std::size_t k = 0; k < triangles.size(); ++k)
      for (std::size_t i = 0; i < 3; ++i)
        values(static_cast<py::ssize_t>(k), static_cast<py::ssize_t>(i)) = triangles[k][i];
    return array;
  }
};

/// A property given by a function of the run.
template <class Function>
auto of_run(Function function) {
  return [function](CoreSimulation& simulation) { return simulation.with_run(function); };
}

template <class Function>
auto of_block(Function function) {
  return [function](const CoreBlock& block) { return block.of_model(function); };
}

auto vectors_of(Vector3 PointMotion::*part) {
  return [part](const CoreBlock& block, const py::object& points, bool extrapolate) {
    return block.vectors(points, extrapolate, part);
  };
}

void bind_block(py::module_& module) {
  const py::arg points("points");
  const py::arg_v extrapolate = py::arg("extrapolate") = false;
  py::class_<CoreBlock>(module, "Block", made_here(),
                        R"(A block of a simulation at its present time.

Points are material points of the placed, undeformed block. A point outside it by more than a millionth of the diagonal of its
box raises ValueError with the distance; extrapolate=True evaluates the block's polynomial there. If the block is not present,
its motion and stress raise RuntimeError; its shape, volume and mass stay available.)")
      .def_property_readonly("name", of_block([](const BlockModel& b) { return b.name(); }))
      .def_property_readonly("order", of_block([](const BlockModel& b) { return b.rigid() ? 0 : b.order(); }))
      .def_property_readonly("fixed", of_block([](const BlockModel& b) { return b.fixed(); }))
      .def_property_readonly(
          "present",
          [](const CoreBlock& b) {
            return b.of->with_run([&](const Run& run) { return run.present(b.index); });
          },
          "True if the block exists in the present stage; stages remove and add blocks.")
      .def_property_readonly("volume", of_block([](const BlockModel& b) { return b.basis().volume(); }),
                             "Volume of the undeformed block, m^3.")
      .def_property_readonly("mass", of_block([](const BlockModel& b) { return b.mass(); }),
                             "kg; 0 if fixed.")
      .def_property_readonly(
          "coefficients", &CoreBlock::coefficients,
          "Coefficients of the position, (p, 3), m^5/2, relative to the origin of the model.")
      .def_property_readonly("vertices", &CoreBlock::vertices,
                             "Corners of the placed, undeformed block, (n, 3), m.")
      .def_property_readonly("triangles", &CoreBlock::triangles,
                             "Triangles of the surface, (m, 3), indices of vertices.")
      .def("positions", vectors_of(&PointMotion::place), points, extrapolate,
           "Present positions of points of the placed, undeformed block: (n, 3) -> (n, 3), m.")
      .def("displacements", vectors_of(&PointMotion::displacement), points, extrapolate,
           "Displacements of such points since placement: (n, 3) -> (n, 3), m.")
      .def("velocities", vectors_of(&PointMotion::velocity), points, extrapolate,
           "Velocities of such points: (n, 3) -> (n, 3), m/s.")
      .def("stress", &CoreBlock::stress, points, extrapolate,
           "Cauchy stress at such points, tension positive: (n, 3) -> (n, 3, 3), Pa.");
}

std::string status_of(const Run& run) {
  return run.status() ? to_string(*run.status()) : "running";
}

std::vector<std::string> names_of(const Run& run) {
  std::vector<std::string> names;
  for (const BlockModel& block : run.simulation().blocks()) names.push_back(block.name());
  return names;
}

}  // namespace

void bind_simulation(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(ContactRow, a, b, place, normal, force, gap, area, type, state);
  using Shared = std::shared_ptr<CoreSimulation>;
  module.def(
      "simulation",
      [](const CoreScene& scene, int threads, const std::optional<std::filesystem::path>& resume) {
        return std::make_shared<CoreSimulation>(scene, threads, resume);
      },
      py::arg("scene"), py::arg("threads"), py::arg("resume"), py::call_guard<py::gil_scoped_release>());
  py::class_<CoreSimulation, Shared>(module, "Simulation", made_here())
      .def("step",
           [](CoreSimulation& s) { return s.without_interpreter([](Run& run) { return run.step(); }); })
      .def_property_readonly("status", of_run(status_of))
      .def_property_readonly("message", of_run([](const Run& run) { return run.message(); }))
      .def_property_readonly("stage", of_run([](const Run& run) { return run.stage(); }))
      .def_property_readonly("time", of_run([](const Run& run) { return run.simulation().time(); }))
      .def_property_readonly("steps", of_run([](const Run& run) { return run.simulation().steps(); }))
      .def("summary",
           [](CoreSimulation& s) {
             return s.without_interpreter([](const Run& run) { return run.summary(); });
           })
      .def("errors",
           [](CoreSimulation& s) {
             return s.without_interpreter([](const Run& run) { return run.errors(); });
           })
      .def("history", &CoreSimulation::history)
      .def("history_units", &CoreSimulation::history_units)
      .def("contacts", &CoreSimulation::contacts)
      .def("bolts", &CoreSimulation::bolts)
      .def("set_load_factor",
           [](CoreSimulation& s, const std::string& block, int load, double factor) {
             (void)s.index_of(block);
             s.with_run([&](Run& run) { run.set_load_factor(block, load, factor); });
           })
      .def("record",
           [](CoreSimulation& s, const std::filesystem::path& folder) {
             s.without_interpreter([&](Run& run) { run.record(folder); });
           })
      .def("write",
           [](CoreSimulation& s, const std::filesystem::path& folder) {
             s.without_interpreter([&](const Run& run) { run.write(folder); });
           })
      .def("names", of_run(names_of))
      .def("block", [](const Shared& s, const std::string& name) {
        return CoreBlock{s, s->index_of(name)};
      });
  bind_block(module);
}

}  // namespace ashlar
