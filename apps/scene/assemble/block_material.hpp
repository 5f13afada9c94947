// The material of a block, for mechanics.
#pragma once

#include "apps/scene/model/scene.hpp"
#include "mechanics/material/material.hpp"

namespace ashlar {

/// A fixed block may have none.
[[nodiscard]] inline Material material_of(const Scene& scene, std::size_t block) {
  const SceneMaterial* material = find_material(scene, scene.block[block].material);
  if (material == nullptr) return {};
  return {material->density, material->young_modulus, material->poisson_ratio,
          material->elasticity == SceneMaterial::Elasticity::linear ? Elasticity::linear
                                                                    : Elasticity::st_venant_kirchhoff};
}

}  // namespace ashlar
