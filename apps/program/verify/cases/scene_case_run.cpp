#include "apps/program/verify/cases/scene_case_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "apps/program/verify/cases/case_expression.hpp"
#include "apps/program/verify/cases/placed_rows.hpp"
#include "apps/results/columns/history_columns.hpp"
#include "apps/results/text/atomic_file.hpp"
#include "apps/results/text/json_path.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/run/run.hpp"
#include "apps/scene/assemble/scene_loading.hpp"
#include "apps/scene/assemble/scene_reader.hpp"
#include "apps/scene/toml/fault_text.hpp"

namespace ashlar {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// A folder name: the label without characters that shells or file systems treat specially.
std::string folder_name(const std::string& label) {
  std::string name = label.empty() ? "scene" : label;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.' && c != '-' && c != '+') c = '_';
  return name;
}

/// A word of a shell's command line.
std::string shell_word(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + "'";
}

/// Writes how a variant is repeated, with the scene where it is: it may include other files.
void leave_command(const SceneCase& chosen, const CaseVariant& variant, const std::filesystem::path& folder) {
  std::string command = "ashlar run " + shell_word(std::filesystem::absolute(chosen.scene).string());
  for (const std::string& change : variant.overrides) command += " --set " + shell_word(change);
  write_file_atomically(folder / "command.txt", command + "\n", Durability::process);
}

/// Rows of a run in the axes of the scene as it is written.
std::vector<std::vector<double>> own_rows(const SceneCase& chosen, const CaseVariant& variant, const Run& run,
                                          const Placement& placement) {
  if (placement.is_identity()) return run.rows();
  Diagnostics known;  // the scene has been loaded
  const Vector3 origin = read_scene(chosen.scene, variant.overrides, known).origin;
  const std::vector<Column> columns =
      history_columns(measures_of(run.whole(), run.simulation().blocks()), run.stage() > 0);
  return turned_back(columns, run.rows(), placement, placement.point(origin) - run.whole().origin);
}

/// @return empty, with faults in the diagnostics, if the scene has errors
std::optional<CaseResults> results_of(const SceneCase& chosen, const CaseVariant& variant,
                                      const std::filesystem::path& folder, const Placement& placement,
                                      Diagnostics& diagnostics) {
  std::optional<LoadedScene> scene =
      load_scene(chosen.scene, variant.overrides, diagnostics, nullptr, LoadPurpose::run, 1, &placement);
  if (!scene) return std::nullopt;
  Run run(std::move(*scene));
  if (!folder.empty()) {
    std::filesystem::create_directories(folder.parent_path());
    run.record(folder, ClaimPurpose::replacement);
    if (placement.is_identity()) leave_command(chosen, variant, folder);
  }
  try {
    while (run.step()) {
    }
  } catch (const std::runtime_error&) {
    if (run.status() != RunStatus::failed) throw;
  }
  return CaseResults{run.columns(), own_rows(chosen, variant, run, placement), parse_json(run.summary())};
}

/// Evaluates the checks of one variant.
class CheckedVariant {
 public:
  CheckedVariant(const SceneCase& chosen, const CaseVariant& variant, CaseResults results,
                 Diagnostics& diagnostics)
      : chosen_(chosen), variant_(variant), results_(std::move(results)), diagnostics_(diagnostics) {}

  [[nodiscard]] std::vector<VerificationCheck> checks() const {
    std::vector<VerificationCheck> done;
    const std::string status = text_at("summary.status");
    bool judges_status = false;
    for (const CaseCheck& check : chosen_.checks) {
      if (check.when.given() && number(check.when, false) == 0.0) continue;
      judges_status = judges_status || check.value.text == "summary.status";
      done.push_back(result_of(check));
    }
    for (const char* bad : {"failed", "not converged", "interrupted"})
      if (!judges_status && status == bad)
        done.push_back({fmt::format("ended as {}: {}{}", status, text_at("summary.message"), suffix()),
                        not_known, not_known, not_known, 0.0});
    if (done.empty())
      diagnostics_.error(chosen_.place, fmt::format("case {}{}: no check holds for it, one is needed",
                                                    chosen_.name, suffix()));
    return done;
  }

 private:
  [[nodiscard]] std::string suffix() const { return variant_.label.empty() ? "" : ", " + variant_.label; }

  [[nodiscard]] std::string text_at(std::string_view name) const {
    const nlohmann::ordered_json* value = value_at(results_.summary, name.substr(name.find('.') + 1));
    return value != nullptr && value->is_string() ? value->get<std::string>() : "";
  }

  /// @param required a finite number is needed, otherwise any
  [[nodiscard]] double number(const CaseText& expression, bool required) const {
    try {
      const double value = value_of(expression.text, variant_.names, results_);
      if (required && !std::isfinite(value))
        diagnostics_.error(expression.place, fmt::format("case {}{}: {} has no value, a number is needed",
                                                         chosen_.name, suffix(), expression.text));
      return value;
    } catch (const FormulaError& error) {
      Place place = expression.place;
      // Of the text after its quote.
      if (place.column > 0) place.column += 1 + static_cast<int>(error.offset());
      diagnostics_.error(std::move(place),
                         fmt::format("case {}{}: {}", chosen_.name, suffix(), error.what()));
      return not_known;
    }
  }

  [[nodiscard]] VerificationCheck result_of(const CaseCheck& check) const {
    const std::string what = check.what + suffix();
    if (check.kind == CaseCheck::Kind::is) {
      const std::string found = text_at(check.value.text);
      if (found.empty())
        diagnostics_.error(check.value.place,
                           fmt::format("case {}{}: no text ({}), a path to a text of summary.json is needed",
                                       chosen_.name, suffix(), check.value.text));
      const bool same = found == check.expected.text;
      return check_absolute(same ? what : fmt::format("{} (is {})", what, found), same ? 1.0 : 0.0, 1.0, 0.0);
    }
    const double measured = number(check.value, false), reference = number(check.expected, true);
    const double tolerance = check.tolerance.given() ? number(check.tolerance, true) : 0.0;
    VerificationCheck result = check.relative ? check_relative(what, measured, reference, tolerance)
                                              : check_absolute(what, measured, reference, tolerance);
    const bool beyond = check.kind == CaseCheck::Kind::at_least  ? measured >= reference
                        : check.kind == CaseCheck::Kind::at_most ? measured <= reference
                                                                 : false;
    if (beyond) result.error = 0.0;
    return result;
  }

  const SceneCase& chosen_;
  const CaseVariant& variant_;
  CaseResults results_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::vector<VerificationCheck> run_case(const SceneCase& chosen, const std::filesystem::path& kept,
                                        Diagnostics& diagnostics, const Placement& placement) {
  std::vector<VerificationCheck> checks;
  std::map<std::string, int> names;  // of folders
  for (const CaseVariant& variant : chosen.variants) {
    std::filesystem::path folder;
    if (!kept.empty()) {
      // Labels are short: two variants may have the same.
      const std::string name = folder_name(variant.label);
      const int number = ++names[name];
      folder = kept / chosen.name / (number == 1 ? name : fmt::format("{}-{}", name, number));
    }
    std::optional<CaseResults> results = results_of(chosen, variant, folder, placement, diagnostics);
    if (!results) continue;
    for (VerificationCheck& check :
         CheckedVariant(chosen, variant, std::move(*results), diagnostics).checks())
      checks.push_back(std::move(check));
  }
  if (!kept.empty())
    std::filesystem::copy_file(chosen.scene, kept / chosen.name / chosen.scene.filename(),
                               std::filesystem::copy_options::overwrite_existing);
  return checks;
}

}  // namespace ashlar
