#include "apps/program/plot/plot_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "apps/results/folder/scratch_folder.hpp"
#include "apps/results/system/child_program.hpp"
#include "apps/results/text/atomic_file.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/scene/toml/fault_text.hpp"
#include "apps/scene/toml/input_file.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* script_head = R"(#!/usr/bin/env python3
"""Draws a plot by matplotlib: python3 THIS_FILE [PICTURE.svg|.png|.pdf]..."""
import io
import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot

)";

constexpr const char* script_tail = R"(
# Distinguishable without colour vision (Okabe and Ito), then darker ones.
COLORS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#7f3c8d", "#6b6b00", "#a02c2c"]


def plain(text):
    """Text in which a dollar sign begins no formula."""
    return text.replace("$", r"\$")


def draw():
    figure, axes = pyplot.subplots(figsize=(10, 6), layout="constrained")
    color = -1
    for series in plot["series"]:
        if color < 0 or not series["same_color_as_last"]:
            color += 1
        style = {"color": COLORS[color % len(COLORS)], "linestyle": "--" if series["dashed"] else "-" if series["line"] else "none"}
        if series["marks"]:
            style.update(marker="o", markersize=5, markerfacecolor="white" if series["dashed"] else style["color"])
        axes.plot(series["x"], series["y"], label=plain(series["name"]), **style)
    if any(series["x"] for series in plot["series"]):
        for axis, logarithmic in zip("xy", plot["logarithmic"]):
            if logarithmic:
                axes.set(**{axis + "scale": "log"})
    axes.set(title=plain(plot["title"]), xlabel=plain(plot["x_label"]), ylabel=plain(plot["y_label"]))
    axes.grid(True, which="major", color="#cccccc")
    axes.grid(True, which="minor", color="#eeeeee")
    if plot["series"]:
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), frameon=False, title=plot["note"])
    return figure


# Text remains text, and equal plots make equal files.
matplotlib.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "ashlar"})
for name in sys.argv[1:] or [pathlib.Path(__file__).with_suffix(".svg")]:
    file = pathlib.Path(name)
    if file.suffix == ".svg":
        text = io.StringIO()
        draw().savefig(text, format="svg", metadata={"Date": None})
        file.write_text(text.getvalue()[text.getvalue().index("<svg"):], encoding="utf-8")
    else:
        draw().savefig(file, dpi=100)
)";

bool is_drawn(const Plot& plot, double x, double y) {
  return std::isfinite(x) && std::isfinite(y) && (plot.axes == PlotAxes::linear || x > 0.0) &&
         (plot.axes != PlotAxes::logarithmic || y > 0.0);
}

Json to_json(const PlotSeries& series, const Plot& plot) {
  const double slope = plot.slopes ? last_slope(series) : std::nan("");
  Json x = Json::array(), y = Json::array();
  for (std::size_t k = 0; k < std::min(series.x.size(), series.y.size()); ++k) {
    if (!is_drawn(plot, series.x[k], series.y[k])) continue;
    x.push_back(series.x[k]);
    y.push_back(series.y[k]);
  }
  return {{"name", series.name + (std::isfinite(slope) ? fmt::format(", slope {:.2f}", slope) : "")},
          {"x", std::move(x)},
          {"y", std::move(y)},
          {"dashed", series.dashed},
          {"marks", series.marks},
          {"line", series.line},
          {"same_color_as_last", series.same_color_as_last}};
}

/// Interpreters to try, in order.
std::vector<std::string> interpreters() {
  if (const char* chosen = std::getenv("ASHLAR_PYTHON")) return {chosen};
  std::vector<std::string> found;
  for (const char* name : {"python3", "python"})  // the second is its name on Windows
    if (const auto first = find_program(name); first && found.empty()) found.push_back(first->string());
  constexpr const char* of_system = "/usr/bin/python3";
  if (is_executable(of_system)) found.emplace_back(of_system);
  return found;
}

/// Lets an interpreter draw files. @return empty if it does; otherwise the last line of its errors, or another reason
std::string failure_of(const std::string& interpreter, const std::string& script,
                       const std::vector<std::filesystem::path>& files, const ScratchFolder& scratch) {
  constexpr std::chrono::seconds limit(60);
  // Isolated: neither modules beside the script nor those that variables name are imported.
  std::vector<std::string> command = {interpreter, "-I", std::filesystem::absolute(script).string()};
  for (const std::filesystem::path& file : files) command.push_back(file.string());
  const std::filesystem::path errors = scratch.path() / "errors";
  try {
    const std::optional<int> status = run_program(command, scratch.path() / "out", errors, limit);
    if (!status) return fmt::format("did not finish within {} s", limit.count());
    if (*status == 0) return {};
  } catch (const std::exception& error) {
    return fault_text(error);
  }
  std::string text = whole_file(errors);
  while (text.ends_with('\n')) text.pop_back();
  const std::string last = text.substr(text.rfind('\n') + 1);
  return last.empty() ? "failed" : last;
}

std::string name_with(const std::filesystem::path& picture, const char* extension) {
  return std::filesystem::path(picture).replace_extension(extension).string();
}

FileKind script_kind() {
  return {"script of a plot", {plot_script_mark}};
}

}  // namespace

std::string plot_script(const Plot& plot) {
  Json series = Json::array();
  for (const PlotSeries& one : plot.series) series.push_back(to_json(one, plot));
  const Json all = {{"title", plot.title},
                    {"x_label", plot.x_label},
                    {"y_label", plot.y_label},
                    {"logarithmic", {plot.axes != PlotAxes::linear, plot.axes == PlotAxes::logarithmic}},
                    {"note", plot.slopes ? "slopes of the last three points" : ""},
                    {"series", std::move(series)}};
  // A text of JSON is one of Python too.
  return fmt::format("{}plot = json.loads({})\n{}", script_head, json_text(Json(json_text(all))),
                     script_tail);
}

void refuse_other_plot(const std::filesystem::path& picture, bool png) {
  if (png) refuse_other_file(name_with(picture, ".png"), png_picture());
  refuse_other_file(name_with(picture, ".svg"), svg_picture());
  refuse_other_file(name_with(picture, ".py"), script_kind());
}

std::string write_plot(const Plot& plot, const std::filesystem::path& picture, bool png) {
  refuse_other_plot(picture, png);
  const std::string script = name_with(picture, ".py");
  write_file_of_kind(script, plot_script(plot), script_kind());
  std::vector<std::pair<std::string, FileKind>> files = {{name_with(picture, ".svg"), svg_picture()}};
  if (png) files.emplace_back(name_with(picture, ".png"), png_picture());
  // Drawn there and written here: a picture is whole or not there.
  const ScratchFolder scratch;
  std::vector<std::filesystem::path> drawn = {scratch.path() / "plot.svg"};
  if (png) drawn.push_back(scratch.path() / "plot.png");
  std::string reason = "there is no python3";
  for (const std::string& interpreter : interpreters()) {
    reason = failure_of(interpreter, script, drawn, scratch);
    if (reason.empty()) {
      std::string text;
      for (std::size_t k = 0; k < files.size(); ++k) {
        write_file_of_kind(files[k].first, whole_file(drawn[k]), files[k].second);
        text += fmt::format("picture: {}\n", files[k].first);
      }
      return text;
    }
    reason = fmt::format("{}: {}", interpreter, reason);
  }
  return fmt::format("no picture: {}; python3 with matplotlib draws it by {}\n", reason, script);
}

}  // namespace ashlar
