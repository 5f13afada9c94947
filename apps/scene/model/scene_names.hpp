// Words of the scene format for each choice, in their order in lists for users.
#pragma once

#include <array>
#include <utility>

#include "apps/scene/model/scene.hpp"

namespace ashlar {

template <typename Choice, std::size_t count>
using ChoiceNames = std::array<std::pair<const char*, Choice>, count>;

inline constexpr ChoiceNames<SceneAnalysis::Type, 6> analysis_type_names = {
    {{"dynamic", SceneAnalysis::Type::dynamic},
     {"static", SceneAnalysis::Type::statics},
     {"factor-of-safety", SceneAnalysis::Type::safety},
     {"capacity", SceneAnalysis::Type::capacity},
     {"thrust", SceneAnalysis::Type::thrust},
     {"pushover", SceneAnalysis::Type::pushover}}};

inline constexpr ChoiceNames<SceneAnalysis::Method, 3> method_names = {
    {{"auto", SceneAnalysis::Method::automatic},
     {"limit", SceneAnalysis::Method::limit},
     {"elastic", SceneAnalysis::Method::elastic}}};

inline constexpr ChoiceNames<SceneAnalysis::Integrator, 3> integrator_names = {
    {{"dda", SceneAnalysis::Integrator::dda},
     {"average-acceleration", SceneAnalysis::Integrator::average_acceleration},
     {"generalized-alpha", SceneAnalysis::Integrator::generalized_alpha}}};

/// The members of SceneAnalysis that the key `formulation` determines.
struct FormulationChoice {
  SceneAnalysis::Formulation formulation;
  bool paper;

  friend constexpr bool operator==(const FormulationChoice&, const FormulationChoice&) = default;
};

inline constexpr ChoiceNames<FormulationChoice, 3> formulation_names = {
    {{"total", {SceneAnalysis::Formulation::total, false}},
     {"incremental", {SceneAnalysis::Formulation::incremental, false}},
     {"paper", {SceneAnalysis::Formulation::incremental, true}}}};

inline constexpr ChoiceNames<SceneAnalysis::InitialState, 3> initial_state_names = {
    {{"as-placed", SceneAnalysis::InitialState::as_placed},
     {"equilibrium", SceneAnalysis::InitialState::equilibrium},
     {"static", SceneAnalysis::InitialState::statics}}};

/// Codes of a spectrum.
inline constexpr ChoiceNames<SceneSpectrum::Source, 2> spectrum_code_names = {
    {{"ec8", SceneSpectrum::Source::ec8}, {"ntc2018", SceneSpectrum::Source::ntc2018}}};

inline constexpr ChoiceNames<SceneSpectrum::Soil, 5> soil_names = {{{"A", SceneSpectrum::Soil::a},
                                                                    {"B", SceneSpectrum::Soil::b},
                                                                    {"C", SceneSpectrum::Soil::c},
                                                                    {"D", SceneSpectrum::Soil::d},
                                                                    {"E", SceneSpectrum::Soil::e}}};

inline constexpr ChoiceNames<SceneAnalysis::Solver, 3> solver_names = {
    {{"auto", SceneAnalysis::Solver::automatic},
     {"cholmod", SceneAnalysis::Solver::cholmod},
     {"cg", SceneAnalysis::Solver::cg}}};

inline constexpr ChoiceNames<SceneContact::Springs, 2> springs_names = {
    {{"area", SceneContact::Springs::area}, {"point", SceneContact::Springs::point}}};

inline constexpr ChoiceNames<SceneContact::Surface, 2> surface_names = {
    {{"curved", SceneContact::Surface::curved}, {"flat", SceneContact::Surface::flat}}};

inline constexpr ChoiceNames<SceneCut::Spacing, 4> spacing_names = {
    {{"normal", SceneCut::Spacing::normal},
     {"lognormal", SceneCut::Spacing::lognormal},
     {"uniform", SceneCut::Spacing::uniform},
     {"exponential", SceneCut::Spacing::exponential}}};

inline constexpr ChoiceNames<SceneOutput::Format, 2> frame_format_names = {
    {{"vtu", SceneOutput::Format::vtu}, {"vtkhdf", SceneOutput::Format::vtkhdf}}};

inline constexpr ChoiceNames<SceneOutput::Precision, 3> precision_names = {
    {{"auto", SceneOutput::Precision::automatic},
     {"single", SceneOutput::Precision::of_single},
     {"double", SceneOutput::Precision::of_double}}};

inline constexpr ChoiceNames<SceneBolt::Anchorage, 2> anchorage_names = {
    {{"grouted", SceneBolt::Anchorage::grouted}, {"ends", SceneBolt::Anchorage::ends}}};

inline constexpr ChoiceNames<SceneBoundary::Kind, 2> boundary_kind_names = {
    {{"quiet", SceneBoundary::Kind::quiet}, {"free-field", SceneBoundary::Kind::free_field}}};

inline constexpr ChoiceNames<SceneMaterial::Elasticity, 2> elasticity_names = {
    {{"linear", SceneMaterial::Elasticity::linear},
     {"st-venant-kirchhoff", SceneMaterial::Elasticity::st_venant_kirchhoff}}};

inline constexpr ChoiceNames<SceneMesh::Split, 4> split_names = {
    {{"none", SceneMesh::Split::none},
     {"components", SceneMesh::Split::components},
     {"groups", SceneMesh::Split::groups},
     {"tetrahedra", SceneMesh::Split::tetrahedra}}};

inline constexpr ChoiceNames<bool SceneOutput::Fields::*, 4> field_names = {
    {{"displacement", &SceneOutput::Fields::displacement},
     {"velocity", &SceneOutput::Fields::velocity},
     {"stress", &SceneOutput::Fields::stress},
     {"principal_stress", &SceneOutput::Fields::principal_stress}}};

/// The word of a choice.
template <typename Choice, std::size_t count>
[[nodiscard]] constexpr const char* name_of(const ChoiceNames<Choice, count>& names, Choice choice) {
  for (const auto& [name, value] : names)
    if (value == choice) return name;
  return "";
}

/// The word of an analysis' formulation.
[[nodiscard]] constexpr const char* formulation_name(const SceneAnalysis& analysis) {
  return name_of(formulation_names, {analysis.formulation, analysis.paper});
}

}  // namespace ashlar
