#include "apps/scene/assemble/block_survey.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <set>
#include <utility>

#include "apps/scene/check/warnings/turned_supports.hpp"
#include "geometry/index.hpp"
#include "solver/ranks/rank_messages.hpp"

namespace ashlar {
namespace {

/// Numbers and faults of some blocks, as ranks tell them.
struct SurveyedBlocks {
  std::vector<BlockSummary> blocks;
  std::vector<std::vector<Diagnostic>> faults;  ///< by block
  std::vector<std::size_t> kinds;               ///< BlockPartsLibrary::kinds()
};

/// @return empty if the block cannot be modelled, which is reported
std::optional<BlockModel> model_or_fault(const SceneModels& models, std::size_t index,
                                         BlockPartsLibrary& library, Diagnostics& diagnostics) {
  const Scene& scene = models.scene();
  const SceneBlock& block = scene.block[index];
  try {
    return models.model(index, library);
  } catch (const OrderTooHigh& error) {
    diagnostics.error(
        scene.places.value(fmt::format("block.{}.order", index)),
        fmt::format(
            "order is too high for the shape of block {} in double precision ({}), at most {} is allowed",
            block.name, block.order, error.highest_safe_order));
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    diagnostics.error(scene.places.key(fmt::format("block.{}", index)),
                      fmt::format("block cannot be modelled ({}): {}", block.name, error.what()));
  }
  return std::nullopt;
}

/// Surveys every step-th block from the first. @param kept receives their models, if not null
SurveyedBlocks surveyed(const SceneModels& models, std::size_t first, std::size_t step,
                        std::vector<BlockModel>* kept, Preparation* preparation) {
  SurveyedBlocks result;
  BlockPartsLibrary library;
  for (std::size_t k = first; k < models.count(); k += step) {
    if (preparation != nullptr)
      preparation->phase(
          fmt::format("model of block {} ({} of {})", models.scene().block[k].name, k + 1, models.count()));
    Diagnostics faults;
    std::optional<BlockModel> model = model_or_fault(models, k, library, faults);
    if (model) warn_of_turned_support(models.scene(), k, *model, faults);
    result.blocks.push_back(model ? summary_of(*model, !is_static(models.scene().analysis)) : BlockSummary());
    result.faults.push_back(faults.sorted());
    if (kept != nullptr && model) kept->push_back(std::move(*model));
  }
  result.kinds = library.kinds();
  return result;
}

bool is_error(const Diagnostic& fault) {
  return fault.severity == Severity::error;
}

/// Warnings are of no use beside errors. @return false after errors
bool report(const std::vector<Diagnostic>& faults, Diagnostics& diagnostics) {
  const bool good = std::none_of(faults.begin(), faults.end(), is_error);
  for (const Diagnostic& fault : faults) {
    if (good)
      diagnostics.warning(fault.place, fault.message);
    else if (is_error(fault))
      diagnostics.error(fault.place, fault.message);
  }
  return good;
}

}  // namespace

std::optional<BlockSurvey> survey_blocks(const SceneModels& models, const RunRanks* ranks,
                                         Diagnostics& diagnostics, Preparation* preparation) {
  BlockSurvey survey;
  const bool several = ranks != nullptr && ranks->several();
  std::vector<SurveyedBlocks> parts;
  if (several)
    parts = values_of_ranks(ranks->ranks, surveyed(models, at(ranks->ranks.own()), at(ranks->ranks.count()),
                                                   nullptr, preparation));
  else
    parts.push_back(surveyed(models, 0, 1, &survey.models, preparation));
  std::vector<Diagnostic> faults;
  std::set<std::size_t> kinds;
  survey.blocks.resize(models.count());
  for (std::size_t k = 0; k < models.count(); ++k) {
    const SurveyedBlocks& part = parts[k % parts.size()];
    survey.blocks[k] = part.blocks[k / parts.size()];
    const std::vector<Diagnostic>& of_block = part.faults[k / parts.size()];
    faults.insert(faults.end(), of_block.begin(), of_block.end());
  }
  for (const SurveyedBlocks& part : parts) kinds.insert(part.kinds.begin(), part.kinds.end());
  survey.different = kinds.size();
  if (!report(faults, diagnostics)) return std::nullopt;
  return survey;
}

}  // namespace ashlar
