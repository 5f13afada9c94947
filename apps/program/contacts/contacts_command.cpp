#include "apps/program/contacts/contacts_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <numbers>
#include <ostream>
#include <span>
#include <unordered_map>
#include <vector>

#include "apps/program/contacts/contact_report_json.hpp"
#include "apps/program/number_option.hpp"
#include "apps/scene/meshes/mesh_loading.hpp"
#include "apps/scene/model/diagnostics.hpp"
#include "solver/parallel_for.hpp"

namespace ashlar {
namespace {

constexpr const char* help_text =
    "The contact of two closed meshes (.off, .obj, .stl, .ply, .msh), decided exactly on the given doubles: "
    "relation, type, region, distance, contact points, and the depth where they cross.\n"
    "LIST has one pair a line: two file names, in double quotes if they hold blanks; empty lines and lines "
    "that begin with # are ignored. Names are relative to the current folder, or, where there is no such "
    "file, to the folder of LIST. With --json one object a line is printed for each pair, in order; a pair "
    "that cannot be answered gives {\"error\": [\"...\"]} and exit status 2 when all others are done.";

constexpr const char* not_convex = "solid is not convex, an angle of contact is for convex solids";

Diagnostic fault_at(const std::string& origin, int line, int column, std::string message) {
  Diagnostic fault;
  fault.place.origin = origin;
  fault.place.line = line;
  fault.place.column = column;
  fault.message = std::move(message);
  return fault;
}

// A file ready for reports, or its faults.
struct LoadedBody {
  std::optional<ReportedSolid> body;
  std::vector<Diagnostic> faults;
};

LoadedBody load_body(const std::string& path, const std::filesystem::path& file) {
  LoadedBody loaded;
  Diagnostics diagnostics;
  if (std::optional<Polyhedron> solid = load_solid(path, file, diagnostics))
    loaded.body.emplace(std::move(*solid));
  loaded.faults = diagnostics.sorted();
  return loaded;
}

std::optional<Resolution> resolution_of(const ContactsOptions& options) {
  if (!options.distance && !options.angle) return std::nullopt;
  return Resolution{options.distance.value_or(0.0),
                    std::sin(options.angle.value_or(0.0) * std::numbers::pi / 180.0)};
}

// The report of two loaded files. If there is none, faults are added instead.
std::optional<ContactReport> report_of(const LoadedBody& a, const LoadedBody& b, const std::string& a_path,
                                       const std::string& b_path, const std::optional<Resolution>& resolution,
                                       std::vector<Diagnostic>& faults) {
  const auto add_faults = [&](const LoadedBody& body, const std::string& path) {
    faults.insert(faults.end(), body.faults.begin(), body.faults.end());
    if (resolution && resolution->sine > 0.0 && body.body && body.body->shape() == nullptr)
      faults.push_back(fault_at(path, 0, 0, not_convex));
  };
  add_faults(a, a_path);
  if (b_path != a_path) add_faults(b, b_path);
  if (!faults.empty()) return std::nullopt;
  return report_contact(*a.body, *b.body, resolution);
}

int answer_two_meshes(const ContactsOptions& options, std::ostream& out, std::ostream& err) {
  const LoadedBody a = load_body(options.a, options.a);
  const LoadedBody b = load_body(options.b, options.b);
  std::vector<Diagnostic> faults;
  const auto report = report_of(a, b, options.a, options.b, resolution_of(options), faults);
  if (!report) {
    for (const Diagnostic& fault : faults) err << to_string(fault) << '\n';
    return exit_status::bad_input;
  }
  if (options.json)
    out << contact_report_json(*report, options.angle.value_or(0.0)) << '\n';
  else
    out << contact_report_text(*report, options.a, options.b);
  return exit_status::done;
}

// A word of the list with its column, from 1.
struct ListedPath {
  std::string path;
  int column = 0;
};

struct ListedPair {
  int line = 0;
  std::vector<ListedPath> paths;  // two, otherwise the line is faulty
  bool open_quote = false;
};

// Columns count characters (UTF-8), as for all places.
int column_of(std::string_view line, std::size_t byte) {
  int column = 1;
  for (std::size_t i = 0; i < byte; ++i) column += (static_cast<unsigned char>(line[i]) & 0xc0U) != 0x80U;
  return column;
}

ListedPair split_line(std::string_view line, int number) {
  constexpr std::string_view blanks = " \t\r";
  ListedPair pair{number, {}, false};
  std::size_t i = line.find_first_not_of(blanks);
  while (i < line.size()) {
    const bool quoted = line[i] == '"';
    const std::size_t begin = quoted ? i + 1 : i;
    std::size_t end = quoted ? line.find('"', begin) : line.find_first_of(blanks, begin);
    if (end == std::string_view::npos) {
      pair.open_quote = pair.open_quote || quoted;
      end = line.size();
    }
    pair.paths.push_back({std::string(line.substr(begin, end - begin)), column_of(line, i)});
    i = end < line.size() ? line.find_first_not_of(blanks, quoted ? end + 1 : end) : end;
  }
  return pair;
}

std::vector<ListedPair> read_list(std::istream& file) {
  file.exceptions(std::ios::badbit);  // a failed allocation is not the end of the file
  std::vector<ListedPair> pairs;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    ListedPair pair = split_line(line, number);
    if (!pair.paths.empty() && !pair.paths[0].path.starts_with('#')) pairs.push_back(std::move(pair));
  }
  return pairs;
}

class PairList {
 public:
  PairList(const ContactsOptions& options, std::ostream& out, std::ostream& err)
      : options_(options),
        resolution_(resolution_of(options)),
        folder_(std::filesystem::path(*options.pairs).parent_path()),
        out_(out),
        err_(err) {}

  /// Processes a block of pairs at a time: reads its files and answers its pairs, both in parallel, and prints the
  /// answers in order. A file stays in memory until its last pair is answered.
  int answer(std::istream& list) {
    constexpr std::size_t block = 512;
    const std::vector<ListedPair> pairs = read_list(list);
    for (const ListedPair& pair : pairs)
      for (const ListedPath& listed : pair.paths) ++files_[listed.path].uses;
    for (std::size_t first = 0; first < pairs.size(); first += block)
      answer(std::span(pairs).subspan(first, std::min(block, pairs.size() - first)));
    return status_;
  }

 private:
  struct File {
    std::unique_ptr<const LoadedBody> body;
    int uses = 0;
  };
  struct Answer {
    std::string text;
    std::vector<std::string> faults;
  };

  template <class Work>
  static void in_parallel(std::size_t count, Work work) {
    parallel_for(available_threads(), count, work);
  }

  void answer(std::span<const ListedPair> pairs) {
    load(pairs);
    std::vector<Answer> answers(pairs.size());
    in_parallel(pairs.size(), [&](std::size_t i) { answers[i] = answer(pairs[i]); });
    for (const Answer& answer : answers) {
      out_ << answer.text;
      for (const std::string& fault : answer.faults) err_ << fault << '\n';
      if (!answer.faults.empty()) status_ = exit_status::bad_input;
    }
    for (const ListedPair& pair : pairs)
      for (const ListedPath& listed : pair.paths)
        if (File& file = files_.at(listed.path); --file.uses == 0) file.body.reset();
  }

  void load(std::span<const ListedPair> pairs) {
    std::vector<std::pair<const std::string*, File*>> missing;
    for (const ListedPair& pair : pairs) {
      if (!is_good(pair)) continue;
      for (const ListedPath& listed : pair.paths) {
        File& file = files_.at(listed.path);
        if (file.body) continue;
        file.body = std::make_unique<LoadedBody>();
        missing.emplace_back(&listed.path, &file);
      }
    }
    in_parallel(missing.size(), [&](std::size_t i) {
      const auto& [path, file] = missing[i];
      file->body = std::make_unique<LoadedBody>(load_body(*path, find(*path)));
    });
  }

  [[nodiscard]] std::filesystem::path find(const std::string& path) const {
    std::filesystem::path file(path);
    std::error_code ignored;
    if (file.is_absolute() || folder_.empty() || std::filesystem::exists(file, ignored)) return file;
    std::filesystem::path beside = folder_ / file;
    return std::filesystem::exists(beside, ignored) ? beside : file;
  }

  [[nodiscard]] static bool is_good(const ListedPair& pair) {
    return pair.paths.size() == 2 && !pair.open_quote;
  }

  [[nodiscard]] Answer answer(const ListedPair& pair) const {
    if (!is_good(pair)) {
      const std::string what = pair.open_quote
                                   ? "quote is not closed, allowed are"
                                   : fmt::format("number of files ({}), needed are", pair.paths.size());
      return refuse(
          {fault_at(*options_.pairs, pair.line, pair.paths.back().column, what + " two file names a line")});
    }
    const std::string &a = pair.paths[0].path, &b = pair.paths[1].path;
    std::vector<Diagnostic> faults;
    const auto report = report_of(*files_.at(a).body, *files_.at(b).body, a, b, resolution_, faults);
    if (report && options_.json)
      return {contact_report_json(*report, options_.angle.value_or(0.0)) + '\n', {}};
    if (report) return {contact_report_text(*report, a, b), {}};
    for (Diagnostic& fault : faults) {
      const int column = pair.paths[fault.place.origin == a ? 0 : 1].column;
      fault = fault_at(*options_.pairs, pair.line, column, to_string(fault.place) + ": " + fault.message);
    }
    return refuse(faults);
  }

  [[nodiscard]] Answer refuse(const std::vector<Diagnostic>& faults) const {
    Answer answer;
    for (const Diagnostic& fault : faults) answer.faults.push_back(to_string(fault));
    answer.text = (options_.json ? contact_error_json(answer.faults) : "error: " + answer.faults[0]) + '\n';
    return answer;
  }

  const ContactsOptions& options_;
  std::optional<Resolution> resolution_;
  std::filesystem::path folder_;
  std::ostream& out_;
  std::ostream& err_;
  std::unordered_map<std::string, File> files_;
  int status_ = exit_status::done;
};

}  // namespace

int contacts_command(const ContactsOptions& options, std::ostream& out, std::ostream& err) {
  if (!options.pairs) return answer_two_meshes(options, out, err);
  std::ifstream file(*options.pairs);
  // A folder can be opened, but has no first character.
  if (!file || (file.peek() == std::ifstream::traits_type::eof() && !file.eof())) {
    err << to_string(fault_at(*options.pairs, 0, 0, "list of pairs cannot be read")) << '\n';
    return exit_status::bad_input;
  }
  return PairList(options, out, err).answer(file);
}

void declare_contacts_command(CLI::App& program, CommandContext& context) {
  CLI::App* command = program.add_subcommand("contacts", "Exact contact report of two meshes");
  command->footer(help_text);
  // Shared with the callback that reads it.
  const auto options = std::make_shared<ContactsOptions>();
  CLI::Option* a = command->add_option("A", options->a, "First mesh")->type_name("");
  CLI::Option* b = command->add_option("B", options->b, "Second mesh")->type_name("");
  command->add_option("--pairs", options->pairs, "Many pairs: a file with a line A B for each")
      ->type_name("LIST")
      ->excludes(a, b);
  command
      ->add_option("--distance", options->distance,
                   "Contact distance, m: the type at that resolution (convex solids), all contacts up to it "
                   "(others)")
      ->type_name("D")
      ->transform(real_number_option({.low = 0.0, .words = "a number >= 0"}));
  command
      ->add_option("--angle", options->angle,
                   "Contact angle, deg: the type at that resolution (convex solids)")
      ->type_name("DEG")
      ->transform(real_number_option({.low = 0.0, .high = 90.0, .words = "a number from 0 to 90"}));
  command->add_flag("--json", options->json, "Print JSON, one object a line");
  command->callback([options, &context, a, b] {
    if (a->count() > 0 && b->count() == 0) throw CLI::RequiredError("a second mesh B");
    if (!options->pairs && b->count() == 0) throw CLI::RequiredError("two meshes A B, or --pairs LIST,");
    context.status = contacts_command(*options, context.out, context.err);
  });
}

}  // namespace ashlar
