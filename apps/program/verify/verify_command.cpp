#include "apps/program/verify/verify_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <exception>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>

#include "apps/program/verify/cases/scene_case_run.hpp"
#include "apps/program/verify/verification.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/scene/model/nearest_name.hpp"
#include "apps/scene/toml/fault_text.hpp"

namespace ashlar {
namespace {

/// A case of the list: a scene or built in.
struct ListedCase {
  std::string name;
  std::string description;
  const SceneCase* scene = nullptr;
  std::optional<VerificationCase> built_in = {};
};

/// Scenes first, then, without a folder of the user's own, those built in.
std::vector<ListedCase> listed_cases(const std::vector<SceneCase>& scenes, bool with_built_in) {
  std::vector<ListedCase> all;
  for (const SceneCase& scene : scenes) all.push_back({scene.name, scene.about, &scene});
  if (!with_built_in) return all;
  for (const VerificationCase& built_in : all_verification_cases())
    all.push_back({built_in.name, built_in.description, nullptr, built_in});
  return all;
}

/// The requested cases, in the order of the list; empty, with an error, if a name is unknown.
std::vector<ListedCase> chosen_cases(std::vector<ListedCase> all, const std::vector<std::string>& names,
                                     std::ostream& err) {
  if (names.empty()) return all;
  std::vector<std::string> known;
  known.reserve(all.size());
  for (const ListedCase& candidate : all) known.push_back(candidate.name);
  bool good = true;
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::vector<std::string> likely = likely_names(name, known);
    err << fmt::format("ashlar: error: unknown case ({}), {}--list names all\n", name,
                       likely.empty() ? "" : fmt::format("did you mean {}? ", fmt::join(likely, " or ")));
    good = false;
  }
  if (!good) return {};
  std::erase_if(all, [&](const ListedCase& candidate) {
    return std::find(names.begin(), names.end(), candidate.name) == names.end();
  });
  return all;
}

struct CaseOutcome {
  std::string name;
  std::vector<VerificationCheck> checks;
  double seconds;
  [[nodiscard]] bool passed() const {
    return std::all_of(checks.begin(), checks.end(),
                       [](const VerificationCheck& check) { return check.passed(); });
  }
};

/// A check that has failed for a reason.
VerificationCheck failed_check(std::string reason) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  return {std::move(reason), nan, nan, nan, 0.0};
}

CaseOutcome run(const ListedCase& chosen, const std::filesystem::path& kept, Diagnostics& diagnostics) {
  const auto start = std::chrono::steady_clock::now();
  CaseOutcome outcome{chosen.name, {}, 0.0};
  try {
    outcome.checks =
        chosen.scene != nullptr ? run_case(*chosen.scene, kept, diagnostics) : chosen.built_in->run();
  } catch (const std::exception& error) {
    outcome.checks = {failed_check(fmt::format("could not be run: {}", fault_text(error)))};
  }
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return outcome;
}

void print(const CaseOutcome& outcome, std::ostream& out) {
  out << fmt::format("{} {} ({:.2f} s)\n", outcome.passed() ? "pass" : "FAIL", outcome.name, outcome.seconds);
  for (const VerificationCheck& check : outcome.checks) {
    out << fmt::format("     {} {}: {:.10g}, reference {:.10g}, error {:.2e}, tolerance {:.0e}\n",
                       check.passed() ? "pass" : "FAIL", check.what, check.measured, check.reference,
                       check.error, check.tolerance);
  }
  out.flush();
}

nlohmann::ordered_json to_json(const CaseOutcome& outcome) {
  nlohmann::ordered_json checks = nlohmann::ordered_json::array();
  for (const VerificationCheck& check : outcome.checks) {
    checks.push_back({{"what", check.what},
                      {"measured", check.measured},
                      {"reference", check.reference},
                      {"error", check.error},
                      {"tolerance", check.tolerance},
                      {"passed", check.passed()}});
  }
  return {{"name", outcome.name},
          {"passed", outcome.passed()},
          {"seconds", outcome.seconds},
          {"checks", std::move(checks)}};
}

void list_cases(const std::vector<ListedCase>& all, bool as_json, std::ostream& out) {
  if (!as_json) {
    for (const ListedCase& listed : all) out << fmt::format("{:26} {}\n", listed.name, listed.description);
    return;
  }
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ListedCase& listed : all) {
    nlohmann::ordered_json entry = {{"name", listed.name}, {"description", listed.description}};
    if (listed.scene != nullptr) {
      entry["reference"] = listed.scene->reference;
      entry["source"] = listed.scene->source;
      entry["group"] = std::filesystem::path(listed.scene->place.origin).parent_path().filename().string();
      entry["scene"] = listed.scene->scene.string();
    }
    list.push_back(std::move(entry));
  }
  out << json_text(list, 2) << '\n';
}

/// @return exit status
int run_all(const std::vector<ListedCase>& cases, const VerifyOptions& options, std::ostream& out,
            std::ostream& err) {
  int failed = 0;
  bool evaluated = true;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ListedCase& chosen : cases) {
    Diagnostics faults;
    CaseOutcome outcome = run(chosen, options.kept, faults);
    faults.print(err);
    evaluated = evaluated && faults.good();
    if (!faults.good()) outcome.checks.push_back(failed_check("could not be evaluated"));
    if (!outcome.passed()) ++failed;
    if (options.json)
      list.push_back(to_json(outcome));
    else
      print(outcome, out);
  }
  if (options.json)
    out << json_text({{"passed", failed == 0}, {"cases", std::move(list)}}, 2) << '\n';
  else
    out << fmt::format("{} of {} cases passed\n", cases.size() - static_cast<std::size_t>(failed),
                       cases.size());
  if (!evaluated) return exit_status::bad_input;
  return failed == 0 ? exit_status::done : exit_status::failed;
}

}  // namespace

int verify_command(const VerifyOptions& options, std::ostream& out, std::ostream& err) {
  Diagnostics faults;
  const bool own = !options.folder.empty();
  const std::filesystem::path folder = own ? options.folder : own_cases();
  if (folder.empty())
    err << "ashlar: warning: the scenes of the cases are not installed, only those built in are run\n";
  const std::vector<SceneCase> scenes =
      folder.empty() ? std::vector<SceneCase>() : read_cases(folder, faults);
  faults.print(err);
  if (!faults.good()) return exit_status::bad_input;
  std::vector<ListedCase> all = listed_cases(scenes, !own);
  if (options.list) {
    list_cases(all, options.json, out);
    return exit_status::done;
  }
  const std::vector<ListedCase> cases = chosen_cases(std::move(all), options.cases, err);
  return cases.empty() ? exit_status::bad_input : run_all(cases, options, out, err);
}

void declare_verify_command(CLI::App& program, CommandContext& context) {
  CLI::App* command = program.add_subcommand("verify", "Run cases against independent references");
  // Shared with the callback that reads it.
  const auto options = std::make_shared<VerifyOptions>();
  command->add_option("CASE", options->cases, "Names of cases (default: all)")->type_name("");
  command->add_option("--cases", options->folder, "Folder of your own cases (default: those of the program)")
      ->type_name("FOLDER");
  command->add_option("--keep", options->kept, "Leave scenes and results of the cases there")
      ->type_name("FOLDER");
  command->add_flag("--list", options->list, "List the cases");
  command->add_flag("--json", options->json, "Print JSON");
  command->callback(
      [options, &context] { context.status = verify_command(*options, context.out, context.err); });
}

}  // namespace ashlar
