// The extension ashlar._core: scenes and simulations for the Python module `ashlar`, a thin layer above it
// (ashlar/__init__.py). Arrays are copies: the data of a simulation change when it steps.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/program/blocks/block_text.hpp"
#include "apps/program/command_line.hpp"
#include "apps/program/contacts/contacts_command.hpp"
#include "apps/program/contacts/integrate_command.hpp"
#include "apps/program/run/run_command.hpp"
#include "apps/python/core_scene.hpp"
#include "apps/python/core_simulation.hpp"
#include "apps/results/folder/program_version.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
#include "apps/scene/assemble/scene_schema.hpp"
#include "apps/scene/json/scene_json.hpp"

namespace py = pybind11;

namespace ashlar {
namespace {

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

/// Output of a command of the program with --json. @throws std::invalid_argument with its faults
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

/// @param text of the scene; empty: that of the file
py::tuple run_scene(const std::filesystem::path& scene, const std::optional<std::string>& text,
                    const std::filesystem::path& out, const std::vector<std::string>& overrides, int threads,
                    bool resume, bool force) {
  RunOptions options;
  options.scene = scene;
  options.text = text;
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
    status = run_command(options, err, err);
  }
  return py::make_tuple(status, err.str());
}

void bind_scene(py::module_& module) {
  py::class_<CoreScene>(module, "Scene", made_here())
      .def_property_readonly("good", [](const CoreScene& scene) { return scene.loaded != nullptr; })
      .def("faults", &faults_of)
      .def("json", [](const CoreScene& scene) { return json_text(to_json(scene.good()->scene)); })
      .def("blocks_json", [](const CoreScene& scene) {
        const py::gil_scoped_release released;
        return json_text(report_json(BlockReport(scene.good()), nullptr));
      });
  module.def("load", &load_core, py::arg("text"), py::arg("file"), py::arg("overrides"));
}

void bind_commands(py::module_& module) {
  module.def("run", &run_scene);
  module.def("command", [](const std::vector<std::string>& arguments) {
    std::ostringstream out, err;
    int status = 0;
    {
      const py::gil_scoped_release released;
      status = run_command_line(arguments, out, err);
    }
    return py::make_tuple(status, err.str());
  });
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
  module.attr("version") = version_text();
  bind_scene(module);
  bind_simulation(module);
  bind_commands(module);
}
