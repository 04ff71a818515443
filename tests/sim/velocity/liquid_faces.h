// Liquid of a shape, and velocities at the faces that touch it.
#pragma once

#include "sim/grid/mac_grid.h"

namespace fluidtex::sim {

// A box of leaves around the origin with phi, no solids, and all faces active.
struct LiquidFaces {
  double h;
  FloatGrid::Ptr phi, solidPhi;
  Velocity velocity;
  FaceMasks valid{{MaskGrid::create(), MaskGrid::create(), MaskGrid::create()}};

  template <class Distance>
  LiquidFaces(double voxel, int extent, const Distance& distance) : h(voxel) {
    phi = makePhi(h, 100.0);
    solidPhi = makePhi(h, 100.0);
    for (int i = -extent; i < extent; i += 8) {
      for (int j = -extent; j < extent; j += 8) {
        for (int k = -extent; k < extent; k += 8) {
          FloatLeaf* leaf = phi->tree().touchLeaf(Coord(i, j, k));
          for (int n = 0; n < kLeafSize; ++n) {
            const Coord ijk = leaf->offsetToGlobalCoord(n);
            leaf->setValueOn(n, static_cast<float>(distance(phi->indexToWorld(ijk))));
          }
        }
      }
    }
    velocity = makeVelocity(h, phi->constTree());
  }

  // Sets component a to f at faces that touch liquid, and calls them valid.
  template <class F>
  void setValid(const F& f) {
    const auto& masks = valid.component;
    for (int a = 0; a < 3; ++a) {
      FloatGrid& grid = *velocity.component[a];
      for (auto it = grid.beginValueOn(); it; ++it) {
        Coord below = it.getCoord();
        below[a] -= 1;
        if (phi->tree().getValue(it.getCoord()) >= 0.0f && phi->tree().getValue(below) >= 0.0f) continue;
        it.setValue(static_cast<float>(f(grid.indexToWorld(it.getCoord()), a)));
        masks[a]->tree().setValueOn(it.getCoord());
      }
    }
  }
};

}  // namespace fluidtex::sim
