// The public interface of this layer, installed as <ashlar/results.hpp>: result folders, and tables read back. Headers not included from here are internal and not installed.
#pragma once

#include "apps/results/folder/folder_claim.hpp"
#include "apps/results/folder/program_version.hpp"
#include "apps/results/folder/result_folder.hpp"
#include "apps/results/folder/run_status.hpp"
#include "apps/results/frames/largest_values.hpp"
#include "apps/results/tables/history_table.hpp"
#include "apps/results/tables/history_writer.hpp"
#include "apps/results/tables/measure.hpp"
#include "apps/scene/scene_library.hpp"
