// The extension ashlar._core: scenes and simulations for the Python module `ashlar`, which is thin over it
// (ashlar/__init__.py). Arrays are copies: what a simulation holds moves when it steps.
#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/blocks/block_text.hpp"
#include "apps/contacts/contacts_command.hpp"
#include "apps/contacts/integrate_command.hpp"
#include "apps/results/json_text.hpp"
#include "apps/results/program_version.hpp"
#include "apps/results/scene_run.hpp"
#include "apps/run/run_command.hpp"
#include "apps/scene/scene_json.hpp"
#include "apps/scene/scene_loading.hpp"
#include "apps/scene/scene_schema.hpp"
#include "geometry/index.hpp"

namespace py = pybind11;

namespace ashlar {
namespace {

/// A scene and what was found at fault in it.
struct CoreScene {
  std::shared_ptr<const LoadedScene> loaded;  ///< null: there are errors
  std::vector<Diagnostic> faults;             ///< errors and warnings
};

py::list faults_of(const CoreScene& scene) {
  py::list list;
  for (const Diagnostic& fault : scene.faults) {
    py::dict entry;
    entry["file"] = fault.place.origin;
    entry["line"] = fault.place.line;
    entry["column"] = fault.place.column;
    entry["message"] = fault.message;
    entry["severity"] = fault.severity == Severity::error ? "error" : "warning";
    list.append(entry);
  }
  return list;
}

CoreScene load_core(const std::string& text, const std::filesystem::path& file,
                    const std::vector<std::string>& overrides) {
  const py::gil_scoped_release released;
  Diagnostics diagnostics;
  std::optional<LoadedScene> loaded = load_scene_text(text, file, overrides, diagnostics);
  CoreScene scene;
  if (loaded) scene.loaded = std::make_shared<const LoadedScene>(std::move(*loaded));
  scene.faults = diagnostics.sorted();
  return scene;
}

py::array_t<double> array_of(const Eigen::MatrixX3d& matrix) {
  py::array_t<double> array({matrix.rows(), Eigen::Index{3}});
  auto values = array.mutable_unchecked<2>();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index k = 0; k < 3; ++k) values(i, k) = matrix(i, k);
  return array;
}

using Points = py::array_t<double, py::array::c_style | py::array::forcecast>;

std::vector<Vector3> points_of(const Points& array) {
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

/// SceneRun, with arrays of numpy.
class CoreSimulation {
 public:
  CoreSimulation(const CoreScene& scene, int threads) : run_(scene.loaded, threads) {}

  [[nodiscard]] SceneRun& run() { return run_; }
  [[nodiscard]] const SceneRun& run() const { return run_; }
  [[nodiscard]] const Simulation& simulation() const { return run_.simulation(); }
  [[nodiscard]] std::string status() const { return run_.status() ? to_string(*run_.status()) : "running"; }

  [[nodiscard]] py::dict history() const {
    py::dict result;
    const std::vector<std::string> columns = run_.columns();
    for (std::size_t c = 0; c < columns.size(); ++c) {
      py::array_t<double> values(static_cast<py::ssize_t>(run_.rows().size()));
      auto access = values.mutable_unchecked<1>();
      for (std::size_t r = 0; r < run_.rows().size(); ++r)
        access(static_cast<py::ssize_t>(r)) = run_.rows()[r][c];
      result[py::str(columns[c])] = values;
    }
    return result;
  }

  [[nodiscard]] py::array_t<ContactRow> contacts() const {
    std::vector<ContactRow> rows;
    for (const PairRecord& pair : simulation().contacts()) {
      for (std::size_t k = 0; k < pair.points.size(); ++k) {
        const ContactPoint& point = pair.points[k];
        const PointResponse& response = pair.responses[k];
        const Vector3 place = 0.5 * (point.place_a + point.place_b);
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
        row.state = static_cast<std::int32_t>(response.state);
        rows.push_back(row);
      }
    }
    return py::array_t<ContactRow>(static_cast<py::ssize_t>(rows.size()), rows.data());
  }

  [[nodiscard]] int index_of(const std::string& name) const {
    try {
      return run_.block(name);
    } catch (const std::out_of_range&) {
      throw py::key_error(name);
    }
  }

 private:
  SceneRun run_;
};

/// A block of a simulation, by its number.
struct CoreBlock {
  std::shared_ptr<CoreSimulation> of;
  int index;

  [[nodiscard]] const BlockModel& model() const { return of->simulation().blocks()[at(index)]; }
  [[nodiscard]] const BlockState& state() const { return of->simulation().states()[at(index)]; }

  /// @param pick what of a point's motion. @return (n, 3)
  template <class Pick>
  [[nodiscard]] py::array_t<double> vectors(const Points& points, Pick pick) const {
    const std::vector<Vector3> places = points_of(points);
    const std::vector<PointMotion> motions = model().motions_of(state(), places);
    Eigen::MatrixX3d result(static_cast<Eigen::Index>(places.size()), 3);
    for (std::size_t k = 0; k < places.size(); ++k)
      result.row(static_cast<Eigen::Index>(k)) = pick(motions[k]).transpose();
    return array_of(result);
  }

  [[nodiscard]] py::array_t<double> stress(const Points& points) const {
    const std::vector<Vector3> places = points_of(points);
    py::array_t<double> array({static_cast<py::ssize_t>(places.size()), py::ssize_t{3}, py::ssize_t{3}});
    auto values = array.mutable_unchecked<3>();
    const std::vector<PointMotion> motions = model().motions_of(state(), places);
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Eigen::Matrix3d& stress = motions[k].stress;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) values(static_cast<py::ssize_t>(k), i, j) = stress(i, j);
    }
    return array;
  }

  [[nodiscard]] py::array_t<double> vertices() const {
    const std::vector<Vector3>& points = model().solid().mesh().points;
    Eigen::MatrixX3d result(static_cast<Eigen::Index>(points.size()), 3);
    for (std::size_t k = 0; k < points.size(); ++k)
      result.row(static_cast<Eigen::Index>(k)) = points[k].transpose();
    return array_of(result);
  }

  [[nodiscard]] py::array_t<int> triangles() const {
    const auto& triangles = model().solid().mesh().triangles;
    py::array_t<int> array({static_cast<py::ssize_t>(triangles.size()), py::ssize_t{3}});
    auto values = array.mutable_unchecked<2>();
    for (std::size_t k = 0; k < triangles.size(); ++k)
      for (std::size_t i = 0; i < 3; ++i)
        values(static_cast<py::ssize_t>(k), static_cast<py::ssize_t>(i)) = triangles[k][i];
    return array;
  }
};

/// What a command of the program prints with --json. @throws std::invalid_argument with its faults
template <class Command, class Options>
std::string printed(Command command, const Options& options) {
  std::ostringstream out, err;
  int status = 0;
  {
    const py::gil_scoped_release released;
    status = command(options, out, err);
  }
  if (status != exit_status::done) throw std::invalid_argument(err.str().empty() ? out.str() : err.str());
  return out.str();
}

py::tuple run_scene(const std::filesystem::path& scene, const std::filesystem::path& out,
                    const std::vector<std::string>& overrides, int threads, bool resume, bool force) {
  RunOptions options;
  options.scene = scene;
  options.out = out;
  options.overrides = overrides;
  options.threads = threads;
  options.resume = resume;
  options.force = force;
  options.quiet = true;
  std::ostringstream err;
  int status = 0;
  {
    const py::gil_scoped_release released;
    status = run_command(options, err);
  }
  return py::make_tuple(status, err.str());
}

void bind_scene(py::module_& module) {
  py::class_<CoreScene>(module, "Scene")
      .def_property_readonly("good", [](const CoreScene& scene) { return scene.loaded != nullptr; })
      .def("faults", &faults_of)
      .def("json", [](const CoreScene& scene) { return json_text(to_json(scene.loaded->scene)); })
      .def("blocks_json", [](const CoreScene& scene) {
        const py::gil_scoped_release released;
        return json_text(report_json(BlockReport(*scene.loaded), nullptr));
      });
  module.def("load", &load_core, py::arg("text"), py::arg("file"), py::arg("overrides"));
}

void bind_simulation(py::module_& module) {
  py::class_<CoreSimulation, std::shared_ptr<CoreSimulation>>(module, "Simulation")
      .def(py::init<const CoreScene&, int>(), py::arg("scene"), py::arg("threads"),
           py::call_guard<py::gil_scoped_release>())
      .def(
          "step", [](CoreSimulation& s) { return s.run().step(); }, py::call_guard<py::gil_scoped_release>())
      .def_property_readonly("status", &CoreSimulation::status)
      .def_property_readonly("message", [](const CoreSimulation& s) { return s.run().message(); })
      .def_property_readonly("stage", [](const CoreSimulation& s) { return s.run().stage(); })
      .def_property_readonly("time", [](const CoreSimulation& s) { return s.simulation().time(); })
      .def_property_readonly("steps", [](const CoreSimulation& s) { return s.simulation().steps(); })
      .def("history", &CoreSimulation::history)
      .def("contacts", &CoreSimulation::contacts)
      .def("set_load_factor",
           [](CoreSimulation& s, const std::string& block, int load, double factor) {
             (void)s.index_of(block);
             s.run().set_load_factor(block, load, factor);
           })
      .def(
          "record", [](CoreSimulation& s, const std::filesystem::path& folder) { s.run().record(folder); },
          py::call_guard<py::gil_scoped_release>())
      .def(
          "write",
          [](const CoreSimulation& s, const std::filesystem::path& folder) { s.run().write(folder); },
          py::call_guard<py::gil_scoped_release>())
      .def("names",
           [](const CoreSimulation& s) {
             std::vector<std::string> names;
             for (const BlockModel& block : s.simulation().blocks()) names.push_back(block.name());
             return names;
           })
      .def("block", [](const std::shared_ptr<CoreSimulation>& s, const std::string& name) {
        return CoreBlock{s, s->index_of(name)};
      });
}

void bind_block(py::module_& module) {
  py::class_<CoreBlock>(module, "Block", "A block of a simulation, at the simulation's present time.")
      .def_property_readonly("name", [](const CoreBlock& b) { return b.model().name(); })
      .def_property_readonly("order",
                             [](const CoreBlock& b) { return b.model().rigid() ? 0 : b.model().order(); })
      .def_property_readonly("fixed", [](const CoreBlock& b) { return b.model().fixed(); })
      .def_property_readonly(
          "volume", [](const CoreBlock& b) { return b.model().basis().volume(); }, "Undeformed, m^3.")
      .def_property_readonly(
          "mass", [](const CoreBlock& b) { return b.model().mass(); }, "kg; 0 if fixed.")
      .def_property_readonly(
          "coefficients", [](const CoreBlock& b) { return array_of(b.state().position); },
          "Coefficients of the position, (p, 3), m^5/2.")
      .def_property_readonly("vertices", &CoreBlock::vertices, "Of the placed, undeformed block, (n, 3), m.")
      .def_property_readonly("triangles", &CoreBlock::triangles,
                             "Of its surface, (m, 3), indices of vertices.")
      .def(
          "positions",
          [](const CoreBlock& b, const Points& points) {
            return b.vectors(points, [](const PointMotion& motion) { return motion.place; });
          },
          py::arg("points"), "Where points of the placed, undeformed block are now: (n, 3) -> (n, 3), m.")
      .def(
          "displacements",
          [](const CoreBlock& b, const Points& points) {
            return b.vectors(points, [](const PointMotion& motion) { return motion.displacement; });
          },
          py::arg("points"), "How far such points have gone: (n, 3) -> (n, 3), m.")
      .def(
          "velocities",
          [](const CoreBlock& b, const Points& points) {
            return b.vectors(points, [](const PointMotion& motion) { return motion.velocity; });
          },
          py::arg("points"), "Velocities of such points: (n, 3) -> (n, 3), m/s.")
      .def("stress", &CoreBlock::stress, py::arg("points"),
           "Cauchy stress at such points, tension positive: (n, 3) -> (n, 3, 3), Pa.");
}

void bind_commands(py::module_& module) {
  module.def("run", &run_scene);
  module.def("schema", [] { return json_text(scene_schema()); });
  module.def("contacts", [](const std::string& a, const std::string& b) {
    ContactsOptions options;
    options.a = a;
    options.b = b;
    options.json = true;
    return printed(contacts_command, options);
  });
  module.def("integrate", [](const std::string& mesh, int degree) {
    return printed(integrate_command, IntegrateOptions{mesh, degree, true});
  });
}

}  // namespace
}  // namespace ashlar

PYBIND11_MODULE(_core, module) {
  using namespace ashlar;
  PYBIND11_NUMPY_DTYPE(ContactRow, a, b, place, normal, force, gap, area, type, state);
  module.attr("version") = version_text();
  bind_scene(module);
  bind_simulation(module);
  bind_block(module);
  bind_commands(module);
}
