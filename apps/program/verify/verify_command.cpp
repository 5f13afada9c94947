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
#include <ostream>

#include "apps/program/verify/verification.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/scene/model/nearest_name.hpp"
#include "apps/scene/toml/fault_text.hpp"

namespace ashlar {
namespace {

/// The requested cases, in the order of the list; empty, with an error, if a name is unknown.
std::vector<VerificationCase> chosen_cases(const std::vector<std::string>& names, std::ostream& err) {
  std::vector<VerificationCase> all = all_verification_cases();
  if (names.empty()) return all;
  std::vector<std::string> known;
  known.reserve(all.size());
  for (const VerificationCase& candidate : all) known.emplace_back(candidate.name);
  bool good = true;
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::vector<std::string> likely = likely_names(name, known);
    err << fmt::format("ashlar: error: unknown case ({}), {}--list names all\n", name,
                       likely.empty() ? "" : fmt::format("did you mean {}? ", fmt::join(likely, " or ")));
    good = false;
  }
  std::vector<VerificationCase> chosen;
  for (const VerificationCase& candidate : all) {
    if (good && std::find(names.begin(), names.end(), candidate.name) != names.end())
      chosen.push_back(candidate);
  }
  return chosen;
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

CaseOutcome run(const VerificationCase& chosen) {
  const auto start = std::chrono::steady_clock::now();
  CaseOutcome outcome{chosen.name, {}, 0.0};
  try {
    outcome.checks = chosen.run();
  } catch (const std::exception& error) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    outcome.checks = {{fmt::format("could not be run: {}", fault_text(error)), nan, nan, nan, 0.0}};
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

}  // namespace

int verify_command(const VerifyOptions& options, std::ostream& out, std::ostream& err) {
  if (options.list && options.json) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const VerificationCase& listed : all_verification_cases())
      list.push_back({{"name", listed.name}, {"description", listed.description}});
    out << json_text(list, 2) << '\n';
    return exit_status::done;
  }
  if (options.list) {
    for (const VerificationCase& listed : all_verification_cases())
      out << fmt::format("{:26} {}\n", listed.name, listed.description);
    return exit_status::done;
  }
  const std::vector<VerificationCase> cases = chosen_cases(options.cases, err);
  if (cases.empty()) return exit_status::bad_input;
  int failed = 0;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const VerificationCase& chosen : cases) {
    const CaseOutcome outcome = run(chosen);
    if (!outcome.passed()) ++failed;
    if (options.json)
      list.push_back(to_json(outcome));
    else
      print(outcome, out);
  }
  if (options.json) {
    out << json_text({{"passed", failed == 0}, {"cases", std::move(list)}}, 2) << '\n';
  } else {
    out << fmt::format("{} of {} cases passed\n", cases.size() - static_cast<std::size_t>(failed),
                       cases.size());
  }
  return failed == 0 ? exit_status::done : exit_status::failed;
}

void declare_verify_command(CLI::App& program, CommandContext& context) {
  CLI::App* command = program.add_subcommand("verify", "Run built-in cases against independent references");
  // Shared with the callback that reads it.
  const auto options = std::make_shared<VerifyOptions>();
  command->add_option("CASE", options->cases, "Names of cases (default: all)")->type_name("");
  command->add_flag("--list", options->list, "List the cases");
  command->add_flag("--json", options->json, "Print JSON");
  command->callback(
      [options, &context] { context.status = verify_command(*options, context.out, context.err); });
}

}  // namespace ashlar
