#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>
#include <system_error>
#include <utility>

#include "apps/program/command_line.hpp"
#include "apps/program/mcp/argument_schema.hpp"
#include "apps/program/mcp/command_call.hpp"
#include "apps/program/mcp/tools/tools.hpp"
#include "apps/results/tables/history_table.hpp"
#include "apps/results/text/json_path.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/scene/model/nearest_name.hpp"
#include "apps/scene/toml/input_file.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_answer_bytes = 60'000;

ToolAnswer asked_values(const Json& summary, const Json& keys) {
  Json data = Json::object();
  for (const Json& key : keys) {
    const auto path = key.get<std::string>();
    const Json* value = value_at(summary, path);
    if (value == nullptr) {
      std::vector<std::string> names;
      for (const auto& entry : summary.items()) names.push_back(entry.key());
      throw ToolRefusal(fmt::format("the summary has no {}, {}its keys are {}", path, guess(path, names),
                                    fmt::join(names, ", ")));
    }
    data[path] = *value;
  }
  return data_answer(std::move(data));
}

ToolStart tell_the_summary(Workspace& workspace, const Json& arguments) {
  const std::filesystem::path folder = workspace.folder().results(arguments["folder"].get<std::string>());
  const std::filesystem::path file = workspace.folder().file((folder / "summary.json").string());
  Json summary = naming_the_file(
      file, [&] { return parse_json(whole_file(workspace.folder().root() / file, most_input_bytes)); });
  if (arguments.contains("keys")) return asked_values(summary, arguments["keys"]);
  Json left_out = Json::array();
  const auto leave_out = [&](const std::string& key) {
    if (summary.erase(key) > 0) left_out.push_back(key);
  };
  for (const char* key : {"scene", "identity", "columns"}) leave_out(key);
  while (json_text(summary).size() > most_answer_bytes && !summary.empty()) {
    std::string largest;
    std::size_t bytes = 0;
    for (const auto& [key, value] : summary.items())
      if (const std::size_t size = json_text(value).size(); size > bytes) {
        bytes = size;
        largest = key;
      }
    leave_out(largest);
  }
  if (!left_out.empty()) summary["left_out"] = std::move(left_out);
  return data_answer(std::move(summary));
}

/// First, last, least and greatest value of a column, for the rows that were read.
Json column_span(const HistoryTable& table, std::size_t column) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const std::vector<double>& row : table.rows) {
    least = std::min(least, row[column]);
    most = std::max(most, row[column]);
  }
  return {{"column", table.columns[column]},
          {"first", table.rows.front()[column]},
          {"last", table.rows.back()[column]},
          {"least", least},
          {"most", most}};
}

std::vector<std::size_t> columns_asked(const HistoryTable& table, const Json& names) {
  std::vector<std::size_t> columns;
  for (const Json& said : names) {
    const auto name = said.get<std::string>();
    const auto found = std::find(table.columns.begin(), table.columns.end(), name);
    if (found == table.columns.end())
      throw ToolRefusal(fmt::format("the history has no column {}, {}history without columns lists them",
                                    name, guess(name, table.columns)));
    columns.push_back(static_cast<std::size_t>(found - table.columns.begin()));
  }
  return columns;
}

ToolStart tell_the_history(Workspace& workspace, const Json& arguments) {
  constexpr std::size_t usual_rows = 50, most_rows = 100'000;
  const std::filesystem::path folder = workspace.folder().results(arguments["folder"].get<std::string>());
  const std::filesystem::path file = workspace.folder().file((folder / "history.csv").string());
  const HistoryTable all = read_history(workspace.folder().root() / file, most_rows);
  if (all.rows.empty()) throw ToolRefusal("the history has no rows yet; run_status tells how far the run is");
  Json spans = Json::array();
  if (!arguments.contains("columns")) {
    for (std::size_t k = 0; k < all.columns.size(); ++k) spans.push_back(column_span(all, k));
    return data_answer({{"rows_read", all.rows.size()}, {"columns", std::move(spans)}});
  }
  const std::vector<std::size_t> columns = columns_asked(all, arguments["columns"]);
  for (const std::size_t column : columns) spans.push_back(column_span(all, column));
  const HistoryTable few =
      read_history(workspace.folder().root() / file, arguments.value("rows", usual_rows));
  Json rows = Json::array();
  for (const std::vector<double>& row : few.rows) {
    Json values = Json::array();
    for (const std::size_t column : columns) values.push_back(row[column]);
    rows.push_back(std::move(values));
  }
  return data_answer(
      {{"rows_read", all.rows.size()}, {"columns", std::move(spans)}, {"rows", std::move(rows)}});
}

/// A file that is removed with the call.
class ScratchFile {
 public:
  explicit ScratchFile(std::filesystem::path path) : path_(std::move(path)) {}
  ~ScratchFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

ToolStart draw_a_picture(Workspace& workspace, const Json& arguments) {
  const std::filesystem::path folder = workspace.folder().results(arguments["folder"].get<std::string>());
  std::filesystem::path name = workspace.scratch_name();
  name += ".png";
  const auto picture = std::make_shared<ScratchFile>(name);
  std::vector<std::string> words = {"picture", folder.string(), "--out=" + picture->path().string(),
                                    "--size=" + arguments.value("size", std::string("640x480"))};
  for (const char* option : {"frame", "from", "color", "zoom", "scale", "at", "hide", "section", "contacts",
                             "joints", "vectors"}) {
    if (!arguments.contains(option)) continue;
    const Json& value = arguments[option];
    words.push_back(
        fmt::format("--{}={}", option, value.is_string() ? value.get<std::string>() : json_text(value)));
  }
  for (const auto& [argument, flag] : {std::pair("frame_range", "--frame-range"),
                                       {"force_chain", "--force-chain"},
                                       {"thrust_line", "--thrust-line"}})
    if (arguments.value(argument, false)) words.emplace_back(flag);
  return command_call(workspace, {command_line_work(words), true, [picture](const CommandOutcome& outcome) {
                                    if (outcome.status != exit_status::done) return command_error(outcome);
                                    constexpr std::size_t most = 20'000'000;
                                    ToolAnswer answer;
                                    const std::size_t frame = outcome.out.find("(frame ");
                                    answer.text = frame == std::string::npos ? "" : outcome.out.substr(frame);
                                    answer.png = whole_file(picture->path(), most);
                                    return answer;
                                  }});
}

ToolStart write_the_page(Workspace& workspace, const Json& arguments) {
  const std::filesystem::path folder = workspace.folder().results(arguments["folder"].get<std::string>());
  return command_call(workspace, {command_line_work({"view", folder.string()}), true,
                                  [folder](const CommandOutcome& outcome) {
                                    if (outcome.status != exit_status::done) return command_error(outcome);
                                    return ToolAnswer{fmt::format("written: {}, a page for any browser",
                                                                  (folder / "view.html").string()),
                                                      nullptr, "", false};
                                  }});
}

Json picture_arguments(const Json& folder) {
  return arguments_schema(
      {{"folder", folder},
       {"frame",
        whole_number_argument("Index of the frame, 0 the first; the last by default", 0, 100'000'000)},
       {"size", text_argument("WIDTHxHEIGHT, pixels; 640x480 by default")},
       {"from", text_argument("Direction to the eye, x,y,z, or front, back, left, right, top, iso")},
       {"color",
        word_argument("Colour by; displacement by default",
                      {"displacement", "displacement_x", "displacement_y", "displacement_z", "velocity",
                       "von_mises", "pressure", "sigma_1", "sigma_3", "stress_xx", "stress_yy", "stress_zz",
                       "stress_xy", "stress_yz", "stress_xz", "block", "order", "stone"})},
       {"frame_range", flag_argument("Colours over the values of this frame, not of the whole run")},
       {"zoom", number_argument("Magnification; 1 shows all blocks", 1e-3, 1e6)},
       {"scale", number_argument("Displacements times this; 1 by default", 1e-6, 1e9)},
       {"at", text_argument("Centre of the view, x,y,z, m")},
       {"hide", text_argument("Names of blocks that are not drawn, a,b")},
       {"section", text_argument("Cut at x = 0.5: x,0.5; keeping the other side: -x,0.5")},
       {"contacts", word_argument("Contact points by", {"auto", "state", "type", "none"})},
       {"joints",
        word_argument("Joint faces by", {"none", "opening", "slip", "state", "normal", "shear", "water"})},
       {"vectors", word_argument("Arrows of", {"none", "displacement", "velocity"})},
       {"force_chain", flag_argument("A bar for the force in each joint")},
       {"thrust_line", flag_argument("The line through the forces in the joints")}},
      {"folder"});
}

}  // namespace

std::vector<Tool> result_tools(Workspace& workspace) {
  const auto with = [&workspace](ToolStart (*call)(Workspace&, const Json&)) {
    return [&workspace, call](const Json& arguments) { return call(workspace, arguments); };
  };
  const Json folder = text_argument("Result folder of a run, such as wall.out");
  std::vector<Tool> tools;
  tools.push_back(
      {"summary", "Summary of a run",
       "How a run ended and its numbers: status, factor of safety, largest displacement and stress, errors, "
       "counts. Large parts are left out and named; keys returns them.",
       arguments_schema({{"folder", folder},
                         {"keys", texts_argument("Only these, by path, such as factor_of_safety.lower")}},
                        {"folder"}),
       true, with(tell_the_summary)});
  tools.push_back(
      {"history", "History of a run",
       "Without columns: all columns of history.csv with first, last, least and greatest value. With "
       "columns: "
       "also rows of these, evenly chosen over the run. SI units.",
       arguments_schema({{"folder", folder},
                         {"columns", texts_argument("Names, such as time, tip.uz, energy.kinetic")},
                         {"rows", whole_number_argument("At most so many rows; 50 by default", 1, 2000)}},
                        {"folder"}),
       true, with(tell_the_history)});
  tools.push_back(
      {"picture", "Draw a picture of a run",
       "A frame of the blocks as a PNG image, coloured by a field. Needs Chromium on the server's machine.",
       picture_arguments(folder), true, with(draw_a_picture)});
  tools.push_back(
      {"view_page", "Write the page of results",
       "Write view.html into the result folder: one file that a person opens in any browser, with the model "
       "in motion, plots and the summary.",
       arguments_schema({{"folder", folder}}, {"folder"}), false, with(write_the_page)});
  return tools;
}

}  // namespace ashlar
