// The public interface of this layer, installed as <ashlar/run.hpp>: runs of scenes step by step, with observers and
// answers. Headers not included from here are internal and not installed.
#pragma once

#include "apps/results/folder/run_checkpoint.hpp"
#include "apps/results/results_library.hpp"
#include "apps/run/answers/answer.hpp"
#include "apps/run/interrupt_guard.hpp"
#include "apps/run/run.hpp"
#include "apps/run/run_observer.hpp"
#include "apps/run/run_progress.hpp"
