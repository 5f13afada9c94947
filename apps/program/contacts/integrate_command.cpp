#include "apps/program/contacts/integrate_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>

#include "apps/program/number_option.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/scene/meshes/mesh_loading.hpp"
#include "mechanics/basis/moments.hpp"

namespace ashlar {
namespace {

constexpr int most_degree = 60;

std::string moments_text(const std::vector<std::array<int, 3>>& exponents,
                         const std::vector<double>& values) {
  std::string text = " a  b  c  integral of X^a Y^b Z^c\n";
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto& [a, b, c] = exponents[k];
    text += fmt::format("{:2} {:2} {:2}  {:.17g}\n", a, b, c, values[k]);
  }
  return text;
}

std::string moments_json(int degree, const std::vector<std::array<int, 3>>& exponents,
                         const std::vector<double>& values) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto& [a, b, c] = exponents[k];
    list.push_back({{"a", a}, {"b", b}, {"c", c}, {"value", values[k]}});
  }
  return json_text({{"degree", degree}, {"moments", std::move(list)}}) + '\n';
}

}  // namespace

int integrate_command(const IntegrateOptions& options, std::ostream& out, std::ostream& err) {
  if (options.degree < 0 || options.degree > most_degree) {
    err << fmt::format("ashlar: error: degree is out of range ({}), a whole number from 0 to {} is needed\n",
                       options.degree, most_degree);
    return exit_status::bad_input;
  }
  Diagnostics diagnostics;
  const std::optional<Polyhedron> solid = load_solid(options.mesh, options.mesh, diagnostics);
  const auto exponents = monomial_exponents(options.degree);
  std::vector<double> values;
  if (solid) values = moments(solid->mesh(), options.degree);
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (std::isfinite(values[k])) continue;
    const auto& [a, b, c] = exponents[k];
    diagnostics.error(
        {options.mesh, 0, 0},
        fmt::format("the moment of X^{} Y^{} Z^{} is beyond the largest double ({}), give a lower "
                    "degree or a smaller unit of length",
                    a, b, c, values[k]));
    break;
  }
  if (!diagnostics.good()) {
    diagnostics.print(err);
    return exit_status::bad_input;
  }
  out << (options.json ? moments_json(options.degree, exponents, values) : moments_text(exponents, values));
  return exit_status::done;
}

void declare_integrate_command(CLI::App& program, CommandContext& context) {
  CLI::App* command = program.add_subcommand("integrate", "All moments of a mesh up to a degree");
  // Shared with the callback that reads it.
  const auto options = std::make_shared<IntegrateOptions>();
  command->add_option("MESH", options->mesh, "Mesh (OFF, OBJ, STL, PLY)")->required()->type_name("");
  command->add_option("--degree", options->degree, "Largest a + b + c")
      ->required()
      ->type_name("N")
      ->transform(whole_number_option(0, most_degree));
  command->add_flag("--json", options->json, "Print JSON");
  command->callback(
      [options, &context] { context.status = integrate_command(*options, context.out, context.err); });
}

}  // namespace ashlar
