// Solids and the walls of the domain: who is there at a time, how far away, how much of each face is open,
// and how they move.
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

// Value of a face whose velocity is not given.
inline constexpr float kNotGiven = std::numeric_limits<float>::max();

// A face of which a solid leaves less than this share open counts as closed where the pressure does not say
// how fast it is.
inline constexpr float kLeastOpen = 0.1f;

// What the solver needs to know about a set of solids, in some chunks of cells; nothing is known of others.
// The centre of cell (i,j,k) is at ((i+1/2) h, (j+1/2) h, (k+1/2) h). Everything outside the domain is solid.
struct SolidField {
  double voxelSize = 0.0;  // h, metres
  CoordBBox domain;        // its cells, see domainCells; a last layer may be cut by the domain's wall
  Chunks chunks;
  // The domain's sides. Beyond one that is open or a stream's cut lies solid as behind a wall, but its own
  // faces are open where no solid is in the way.
  std::array<Side, 6> sides{};
  // Signed distance at cell centres in metres, negative inside solids and outside the domain. Active within 3
  // voxels of a boundary, elsewhere the inactive values +-3 h. Right up to 8 cells outside the domain;
  // beyond, background.
  FloatGrid::Ptr phi;
  // The same of all but the sides of symmetry, beyond which it is its own mirror image; phi itself where
  // there are none.
  FloatGrid::Ptr phiMirrored;
  // Open share of each face's area, 0 (closed) to 1. Background 0; tiles of 1 where all is open; every face
  // that is not closed is active.
  FaceGrids open;
  // Where walls are so thin that stencils reach through them; null where none is.
  std::shared_ptr<const Visibility> visibility;
  // Velocity of the solids at faces, m/s, near their surface; none where all are at rest.
  FaceGrids speed;
  // Velocity of faces where it is given, m/s, active there, else kNotGiven: the pressure has no say there.
  // None where nothing is given.
  FaceGrids given;
  // What viscous liquid meets at the solids' surfaces (see sim/solids/walls.h). Slip length in metres at cell
  // centres within 3 voxels of a surface: 0 where liquid sticks, infinite where it slips freely; null where
  // it does so everywhere.
  FloatGrid::Ptr slipLength;
  // Velocity of the surfaces along themselves, on top of that of the solids, at faces, m/s; each component
  // null where none slides along it.
  FaceGrids slide;
};

// The same solids with no speed, and given faces with none.
SolidField atRest(const SolidField& solid);

// Solids of a scene over time. Meshes are read once, when constructed (throws as readMesh and MovingMesh do).
class Solids {
 public:
  explicit Solids(const Options& options);

  // Indices into Options::solids of those that exist at time t (from <= t < until).
  std::vector<std::size_t> active(double t) const;

  // The first time after t at which the set changes, or a solid's motion; kForever where it never does again.
  double nextChange(double t) const;

  // One sentence for each solid that is nowhere, or has walls too thin to hold liquid: where, how thin, and
  // which resolution would do.
  std::vector<std::string> warnings() const;

  // Signed distance at world position x to the active solids and the domain's walls, metres, negative inside.
  double distance(const Vec3d& x, double t) const;
  // The same for many positions; as long as this is there.
  std::function<double(const Vec3d&)> distanceAt(double t) const;

  // Distances, open faces and speeds and walls at time t, in [0, size]; kept, and made anew only when the set
  // has changed or a solid has moved since the last call.
  std::shared_ptr<const SolidField> at(double t);
  // The same of a given set of solids, at their places of time t, wherever liquid with one of these phis gets
  // to in a step, and around solids that move; kept as long as that does not leave what is known.
  std::shared_ptr<const SolidField> around(const std::vector<const FloatGrid*>& phis, double t,
                                           const std::vector<std::size_t>& set);

 private:
  // A solid that is there, and where.
  struct Placed {
    std::size_t index;
    Pose pose;
    ShapeDistance shape;  // before it is moved
    bool operator==(const Placed& other) const { return index == other.index && pose == other.pose; }
  };
  // A mesh sequence, and the shape that was asked for last.
  struct Sequence {
    MovingMesh mesh;
    int file = 0;
    double part = 0.0;
    ShapeDistance shape;
  };
  Placed placed(std::size_t index, double t) const;
  std::vector<Placed> placed(double t, const std::vector<std::size_t>& set) const;
  double distanceTo(const Placed& solid, const Vec3d& x) const;
  // Which sides of the domain count; unbounded ones never do.
  using SideSet = bool (*)(Side);
  double sideDistance(const Vec3d& x, SideSet counts) const;
  double sideAt(int side) const;
  double distanceTo(const std::vector<Placed>& solids, const Vec3d& x, SideSet counts) const;
  // Where the last face of the domain lies along an axis, seen from a side that is no wall.
  double lastFace(int axis) const;
  // Its mirror image where x lies beyond a side of symmetry.
  Vec3d mirrored(Vec3d x) const;
  const Wall& nearestWall(const std::vector<Placed>& solids, const Vec3d& x) const;
  Vec3d velocityOf(const Placed& solid, const SurfaceVelocity* change, const Vec3d& x, double distance) const;
  void addSpeeds(SolidField& field, const std::vector<Placed>& solids) const;
  struct Thinness {
    bool there = false;           // any of the solid is among the domain's cells
    double thickness = kForever;  // metres: of its thinnest wall, where that is thinner than walls that hold
    Vec3d place{0.0};             // of that
  };
  Thinness thinnest(const Placed& solid) const;
  Chunks movingChunks(const std::vector<Placed>& solids, const CoordBBox& box) const;
  SolidField fieldOf(const std::vector<Placed>& solids, Chunks chunks) const;

  Options m_options;
  CoordBBox m_domain;
  std::array<Wall, 6> m_walls;  // of the domain
  // For each of Options::solids one or the other.
  std::vector<std::optional<ShapeDistance>> m_shapes;
  mutable std::vector<std::optional<Sequence>> m_sequences;
  mutable std::mutex m_sequencesInUse;
  std::vector<Placed> m_cachedSet;
  std::shared_ptr<const SolidField> m_cached;
};

}  // namespace fluidtex::sim
