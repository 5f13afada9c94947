// Data that steps keep beyond the state of a run: surfaces and searches, factors, constant data of audits.
#pragma once

#include "solver/contact/depth_audit.hpp"
#include "solver/step/detect/step_contacts.hpp"
#include "solver/step/island/factor_cache.hpp"

namespace ashlar {

/// A function that takes only one of them changes no other. A change of a block's model concerns all three
/// (block_changes.hpp).
struct StepCaches {
  StepContacts contacts;
  FactorCache factors;
  DepthAudit audit;
};

}  // namespace ashlar
