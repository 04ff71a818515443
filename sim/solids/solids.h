// Solids and the walls of the domain: which exist at a time, their distance, face area fractions and
// velocities.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/options.h"
#include "sim/shapes/moving_mesh.h"
#include "sim/shapes/pose.h"
#include "sim/shapes/shape_distance.h"
#include "sim/solids/chunks.h"
#include "sim/solids/visibility.h"

#include <openvdb/openvdb.h>

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace fluidtex::sim {

class SurfaceVelocity;

// Value of faces without a given velocity.
inline constexpr float kNotGiven = std::numeric_limits<float>::max();

// Faces with a smaller open area fraction count as closed where the pressure does not determine their
// velocity.
inline constexpr float kLeastOpen = 0.1f;

// A set of solids on the grid, in some chunks of cells; other chunks hold no data. The centre of cell (i,j,k)
// is at ((i+1/2) h, (j+1/2) h, (k+1/2) h). Everything outside the domain is solid.
struct SolidField {
  double voxelSize = 0.0;  // h, metres
  CoordBBox domain;        // its cells, see domainCells; the domain's wall may cut the last layer
  Chunks chunks;
  // The domain's sides. Beyond an open or stream side is solid, as behind a wall, but the side's own faces
  // are open where no solid covers them.
  std::array<Side, 6> sides{};
  // Signed distance at cell centres in metres, negative inside solids and outside the domain. Active within 3
  // voxels of a boundary, elsewhere inactive with +-3 h. Valid up to 8 cells outside the domain; beyond,
  // background.
  FloatGrid::Ptr phi;
  // The same without symmetry sides, beyond which it is its own mirror image; phi itself where there are
  // none.
  FloatGrid::Ptr phiMirrored;
  // Open area fraction of each face, 0 (closed) to 1. Background 0; tiles of 1 where all is open; every face
  // that is not closed is active.
  FaceGrids open;
  // Visibility of cells where walls are so thin that stencils reach through them; null where there are none.
  std::shared_ptr<const Visibility> visibility;
  // Velocity of the solids at faces, m/s, near their surface; no grids where all are at rest.
  FaceGrids speed;
  // Given velocity of faces, m/s, active there, else kNotGiven. The pressure does not change it. No grids
  // where none is given.
  FaceGrids given;
  // Tangential boundary condition of viscous liquid (see sim/solids/walls.h). Slip length in metres at cell
  // centres within 3 voxels of a surface: 0 for no slip, infinite for free slip; null where all slip freely.
  FloatGrid::Ptr slipLength;
  // Tangential velocity of the surfaces relative to the solids, at faces, m/s; each component null where it
  // is 0 everywhere.
  FaceGrids slide;
};

// The same solids with speed 0, and with given velocities of 0.
SolidField atRest(const SolidField& solid);

// Solids of a scene over time. Meshes are read once, in the constructor, which throws as readMesh and
// MovingMesh do.
class Solids {
 public:
  explicit Solids(const Options& options);

  // Indices into Options::solids of those that exist at time t, s (from <= t < until).
  std::vector<std::size_t> active(double t) const;

  // The first time after t at which the set or a solid's motion changes; kForever where there is none.
  double nextChange(double t) const;

  // One sentence for each solid that is outside the domain, or has walls too thin to hold liquid: where, how
  // thin, and which resolution would do.
  std::vector<std::string> warnings() const;

  // Signed distance at world position x to the active solids and the domain's walls, metres, negative inside.
  double distance(const Vec3d& x, double t) const;
  // The same for many positions at one time; valid while this object exists.
  std::function<double(const Vec3d&)> distanceAt(double t) const;

  // The field of the solids at time t, in [0, size]. Cached; recomputed only when the set has changed or a
  // solid has moved since the last call.
  std::shared_ptr<const SolidField> at(double t);
  // The same for a given set of solids, at their places of time t, wherever liquid with one of these phis can
  // get to in a step, and around moving solids. Cached as long as the liquid stays within.
  std::shared_ptr<const SolidField> around(const std::vector<const FloatGrid*>& phis, double t,
                                           const std::vector<std::size_t>& set);

 private:
  // A solid of the set, and its pose.
  struct Placed {
    std::size_t index;
    Pose pose;
    ShapeDistance shape;  // before it is moved
    bool operator==(const Placed& other) const { return index == other.index && pose == other.pose; }
  };
  // A mesh sequence, and the shape last asked for.
  struct Sequence {
    MovingMesh mesh;
    int file = 0;
    double part = 0.0;
    ShapeDistance shape;
  };
  Placed placed(std::size_t index, double t) const;
  std::vector<Placed> placed(double t, const std::vector<std::size_t>& set) const;
  double distanceTo(const Placed& solid, const Vec3d& x) const;
  // Selects sides of the domain; unbounded ones never count.
  using SideSet = bool (*)(Side);
  double sideDistance(const Vec3d& x, SideSet counts) const;
  double sideAt(int side) const;
  double distanceTo(const std::vector<Placed>& solids, const Vec3d& x, SideSet counts) const;
  // The place of the domain's last face along an axis, for sides that are not walls.
  double lastFace(int axis) const;
  // The mirror image of x where it lies beyond a symmetry side.
  Vec3d mirrored(Vec3d x) const;
  const Wall& nearestWall(const std::vector<Placed>& solids, const Vec3d& x) const;
  Vec3d velocityOf(const Placed& solid, const SurfaceVelocity* change, const Vec3d& x, double distance) const;
  void addSpeeds(SolidField& field, const std::vector<Placed>& solids) const;
  struct Thinness {
    bool there = false;           // any of its surface is among the domain's cells
    double thickness = kForever;  // metres: of its thinnest wall, if too thin to hold
    Vec3d place{0.0};             // of the thinnest wall
  };
  Thinness thinnest(const Placed& solid) const;
  Chunks movingChunks(const std::vector<Placed>& solids, const CoordBBox& box) const;
  SolidField fieldOf(const std::vector<Placed>& solids, Chunks chunks) const;

  Options m_options;
  CoordBBox m_domain;
  std::array<Wall, 6> m_walls;  // of the domain
  // Each of Options::solids has an entry in one of the two.
  std::vector<std::optional<ShapeDistance>> m_shapes;
  mutable std::vector<std::optional<Sequence>> m_sequences;
  mutable std::mutex m_sequencesInUse;
  std::vector<Placed> m_cachedSet;
  std::shared_ptr<const SolidField> m_cached;
};

}  // namespace fluidtex::sim
