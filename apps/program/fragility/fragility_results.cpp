#include "apps/program/fragility/fragility_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "apps/program/sweep/sweep_runs.hpp"
#include "apps/results/text/csv_text.hpp"
#include "apps/results/text/json_text.hpp"
#include "apps/scene/model/scene_record.hpp"
#include "apps/scene/toml/input_file.hpp"

namespace ashlar {
namespace {

using Json = nlohmann::ordered_json;

constexpr int curve_points = 101;

/// Status of a run whose outcome is not certain.
std::string status_without_outcome(const std::filesystem::path& folder) {
  const std::filesystem::path summary = folder / "summary.json";
  if (std::filesystem::exists(summary)) {
    const Json json = naming_the_file(summary, [&] { return parse_json(whole_file(summary)); });
    return json.is_object() ? json.value("status", std::string("damaged")) : "damaged";
  }
  if (std::filesystem::exists(folder / ".ashlar")) return "interrupted";
  return std::filesystem::exists(folder.string() + ".log") ? "refused" : "not run";
}

std::string label_of(const IntensityMeasure& measure) {
  const std::string unit = measure.unit();
  return measure.name() + (unit.empty() ? "" : ", " + unit);
}

/// Intensities from half the least to the largest of all runs, with equal ratios.
std::vector<double> curve_intensities(const std::vector<FragilityRow>& rows) {
  double least = rows.front().intensity, most = least;
  for (const FragilityRow& row : rows) {
    least = std::min(least, row.intensity);
    most = std::max(most, row.intensity);
  }
  least *= 0.5;
  std::vector<double> all;
  for (int k = 0; k < curve_points; ++k)
    all.push_back(least * std::pow(most / least, static_cast<double>(k) / (curve_points - 1)));
  return all;
}

Json or_null(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json bounds_json(const std::optional<FragilityBounds>& bounds) {
  return bounds ? Json::array({or_null(bounds->low), or_null(bounds->high)}) : Json(nullptr);
}

Json confidence_json(const FragilityFit& fit) {
  return {{"level", fit.level},
          {"median", bounds_json(fit.median_bounds)},
          {"dispersion", bounds_json(fit.dispersion_bounds)}};
}

Json curve_json(const std::vector<FragilityRow>& rows, const FragilityFit& fit) {
  Json curve = Json::array();
  if (fit.status != FragilityStatus::fitted) return curve;
  for (const double intensity : curve_intensities(rows)) {
    const auto bounds = fit.probability_bounds(intensity);
    curve.push_back({{"intensity", intensity},
                     {"probability", *fit.probability(intensity)},
                     {"low", bounds ? Json(bounds->low) : Json(nullptr)},
                     {"high", bounds ? Json(bounds->high) : Json(nullptr)}});
  }
  return curve;
}

/// Median in g, of accelerations.
Json median_in_g(const IntensityMeasure& measure, const FragilityFit& fit) {
  if (measure.unit().empty() || !fit.median) return nullptr;
  return *fit.median / standard_gravity;
}

Json limit_json(const FragilityPlan& plan, const IntensityMeasure& measure,
                const std::vector<FragilityRow>& rows, const FragilityFit& fit, std::size_t limit) {
  const auto count = [&](const auto& wanted) {
    return static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), wanted));
  };
  Json json = {{"limit", plan.limits[limit].text},
               {"median", or_null(fit.median)},
               {"median_in_g", median_in_g(measure, fit)},
               {"dispersion", or_null(fit.dispersion)},
               {"confidence", confidence_json(fit)},
               {"fit", word_of(fit.status)},
               {"meaning", describe(fit, measure.unit().empty() ? "" : " " + measure.unit())},
               {"log_likelihood", or_null(fit.likelihood)},
               {"runs", fit.runs},
               {"exceeded", fit.exceeded},
               {"unknown", count([&](const FragilityRow& row) { return !row.exceeded(limit); })},
               {"moving_at_end", count([&](const FragilityRow& row) {
                  return row.status == "moving" && row.exceeded(limit) == false;
                })}};
  json["curve"] = curve_json(rows, fit);
  return json;
}

/// Shares of runs that exceed a limit, in groups of runs with neighbouring intensities.
PlotSeries shares_of(const std::vector<FragilityRow>& rows, std::size_t limit, const std::string& name) {
  constexpr std::size_t most_groups = 10;
  constexpr double one_intensity = 1.0 + 1e-9;  // ratio of intensities that differ by rounding
  std::vector<std::pair<double, bool>> known;
  for (const FragilityRow& row : rows)
    if (const auto exceeded = row.exceeded(limit)) known.emplace_back(row.intensity, *exceeded);
  std::sort(known.begin(), known.end());
  PlotSeries series{fmt::format("{}, share of runs", name), {}, {}};
  series.line = false;
  series.same_color_as_last = true;
  const std::size_t fewest = (known.size() + most_groups - 1) / most_groups;
  for (std::size_t first = 0, end = 0; first < known.size(); first = end) {
    // Runs at one intensity are not divided: they are sorted by their outcome.
    end = std::min(first + fewest, known.size());
    while (end < known.size() && known[end].first <= one_intensity * known[end - 1].first) ++end;
    const auto count = static_cast<double>(end - first);
    double mean = 0.0, share = 0.0;
    for (std::size_t k = first; k < end; ++k) {
      mean += std::log(known[k].first) / count;
      share += known[k].second ? 1.0 / count : 0.0;
    }
    series.x.push_back(std::exp(mean));
    series.y.push_back(share);
  }
  return series;
}

}  // namespace

std::optional<bool> FragilityRow::exceeded(std::size_t limit) const {
  return outcome ? outcome->exceeded(limit) : std::nullopt;
}

std::vector<FragilityRow> rows_of(const FragilityPlan& plan, const std::vector<PlannedRun>& runs) {
  std::vector<FragilityRow> rows;
  for (const PlannedRun& run : runs) {
    FragilityRow& row = rows.emplace_back();
    row.run = &run;
    row.intensity = plan.records[run.record].intensity * run.scale;
    row.outcome = stored_outcome(*run.options.out, plan.limits);
    row.status =
        row.outcome && row.outcome->certain() ? row.outcome->state : status_without_outcome(*run.options.out);
  }
  return rows;
}

FragilityFit fit_of(const std::vector<FragilityRow>& rows, std::size_t limit, double level) {
  std::vector<FragilityRun> runs;
  for (const FragilityRow& row : rows)
    if (const std::optional<bool> exceeded = row.exceeded(limit))
      runs.push_back({row.intensity, *exceeded, row.run->record});
  return fit_fragility(runs, level);
}

SweepTable fragility_table(const FragilityPlan& plan, const IntensityMeasure& measure,
                           const std::vector<FragilityRow>& rows) {
  SweepTable table;
  table.columns = {"record", "scale"};
  for (const VariedKey& key : plan.drawn) table.columns.push_back(quote_csv_field(key.key));
  if (measure.kind != IntensityMeasure::Kind::scale) table.columns.push_back(quote_csv_field(measure.name()));
  table.columns.insert(table.columns.end(), {"folder", "status", "time", "collapse", "block"});
  std::vector<std::size_t> demands;  // limits, each demand once
  for (std::size_t k = 0; k < plan.limits.size(); ++k) {
    const std::string name = quote_csv_field(plan.limits[k].demand);
    if (plan.limits[k].is_collapse() || column_of(table, plan.limits[k].demand)) continue;
    demands.push_back(k);
    table.columns.push_back(name);
  }
  for (const Limit& limit : plan.limits)
    if (!limit.is_collapse()) table.columns.push_back(quote_csv_field(limit.text));
  for (const FragilityRow& row : rows) {
    const auto number = [](double value) {
      std::string field;
      if (std::isfinite(value)) append_csv_number(field, value);
      return field;
    };
    std::vector<std::string>& fields = table.rows.emplace_back();
    fields = {quote_csv_field(plan.records[row.run->record].name), number(row.run->scale)};
    fields.insert(fields.end(), row.run->values.begin(), row.run->values.end());
    if (measure.kind != IntensityMeasure::Kind::scale) fields.push_back(number(row.intensity));
    const std::filesystem::path& out = *row.run->options.out;
    fields.push_back(quote_csv_field(out.parent_path().filename().string() + "/" + out.filename().string()));
    fields.push_back(row.status);
    fields.push_back(row.outcome ? number(row.outcome->time) : "");
    fields.emplace_back(!row.outcome ? "" : row.outcome->collapse ? "1" : row.outcome->certain() ? "0" : "");
    fields.push_back(row.outcome && row.outcome->collapse ? quote_csv_field(row.outcome->collapse->block)
                                                          : "");
    for (const std::size_t k : demands)
      fields.push_back(row.outcome ? number(row.outcome->limits[k].demand) : "");
    for (std::size_t k = 0; k < plan.limits.size(); ++k)
      if (const auto exceeded = row.exceeded(k); !plan.limits[k].is_collapse())
        fields.emplace_back(exceeded ? (*exceeded ? "1" : "0") : "");
  }
  return table;
}

Json fragility_json(const FragilityPlan& plan, const IntensityMeasure& measure,
                    const std::vector<FragilityRow>& rows, const std::vector<FragilityFit>& fits) {
  Json limits = Json::array(), records = Json::array();
  for (std::size_t k = 0; k < fits.size(); ++k) limits.push_back(limit_json(plan, measure, rows, fits[k], k));
  for (const FragilityRecord& record : plan.records)
    records.push_back({{"name", record.name}, {"intensity", record.intensity}, {"duration", record.end}});
  Json json = {{"scene", plan.scene.filename().string()},
               {"intensity", {{"measure", measure.name()}, {"unit", measure.unit()}}}};
  for (const char* key : {"limit", "median", "median_in_g", "dispersion", "confidence", "fit", "meaning"})
    json[key] = limits.front().at(key);
  json["scales"] = plan.scales;
  json["samples"] = std::max<std::size_t>(plan.samples.count, 1);
  json["records"] = std::move(records);
  json["limits"] = std::move(limits);
  return json;
}

Plot fragility_plot(const FragilityPlan& plan, const IntensityMeasure& measure,
                    const std::vector<FragilityRow>& rows, const std::vector<FragilityFit>& fits) {
  Plot plot{"Fragility of " + plan.scene.filename().string(),
            label_of(measure),
            "probability of exceedance",
            {},
            false};
  plot.axes = PlotAxes::linear;
  for (std::size_t k = 0; k < fits.size(); ++k) {
    const std::string& name = plan.limits[k].text;
    PlotSeries curve{name, {}, {}},
        low{fmt::format("{}, {:g} % confidence", name, 100.0 * fits[k].level), {}, {}}, high{"", {}, {}};
    curve.marks = low.marks = high.marks = false;
    low.dashed = high.dashed = low.same_color_as_last = high.same_color_as_last = true;
    for (const double intensity : curve_intensities(rows)) {
      const auto probability = fits[k].probability(intensity);
      if (!probability) break;
      curve.x.push_back(intensity);
      curve.y.push_back(*probability);
      if (const auto bounds = fits[k].probability_bounds(intensity)) {
        low.x.push_back(intensity);
        low.y.push_back(bounds->low);
        high.x.push_back(intensity);
        high.y.push_back(bounds->high);
      }
    }
    if (curve.x.empty()) curve.name += fmt::format(" ({})", word_of(fits[k].status));
    plot.series.push_back(std::move(curve));
    if (!low.x.empty()) {
      plot.series.push_back(std::move(low));
      plot.series.push_back(std::move(high));
    }
    plot.series.push_back(shares_of(rows, k, name));
  }
  return plot;
}

std::optional<Plot> ida_plot(const FragilityPlan& plan, const IntensityMeasure& measure,
                             const std::vector<FragilityRow>& rows, std::size_t limit) {
  if (plan.limits[limit].is_collapse()) return std::nullopt;
  Plot plot{"Incremental dynamic analysis of " + plan.scene.filename().string(),
            plan.limits[limit].demand,
            label_of(measure),
            {},
            false};
  plot.axes = PlotAxes::linear;
  constexpr std::size_t most_named = 12;
  std::map<std::pair<std::size_t, std::vector<std::string>>, std::size_t> lines;
  for (const FragilityRow& row : rows) {
    const auto [line, is_new] =
        lines.emplace(std::pair(row.run->record, row.run->values), plot.series.size());
    if (is_new) {
      const bool named = plan.records.size() <= most_named && plan.drawn.empty();
      plot.series.push_back({named ? plan.records[row.run->record].name : "", {}, {}});
    }
    if (!row.outcome || row.outcome->collapse || !std::isfinite(row.outcome->limits[limit].demand)) continue;
    plot.series[line->second].x.push_back(row.outcome->limits[limit].demand);
    plot.series[line->second].y.push_back(row.intensity);
  }
  return plot;
}

}  // namespace ashlar
