// The public interface of this layer, installed as <ashlar/results.hpp>: stepwise runs of scenes, result folders, and
// tables read back. Headers not included from here are internal and not installed.
#pragma once

#include "apps/results/folder_claim.hpp"
#include "apps/results/history_table.hpp"
#include "apps/results/history_writer.hpp"
#include "apps/results/largest_values.hpp"
#include "apps/results/measure.hpp"
#include "apps/results/program_version.hpp"
#include "apps/results/result_folder.hpp"
#include "apps/results/run_status.hpp"
#include "apps/results/scene_run.hpp"
#include "apps/scene/scene_library.hpp"
