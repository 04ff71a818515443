#include "sim/solids/solids.h"

#include "sim/grid/mac_grid.h"
#include "sim/meshes/read_mesh.h"
#include "sim/shapes/surface_velocity.h"
#include "sim/solids/domain.h"
#include "sim/solids/solid_field.h"
#include "sim/solids/walls.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::sim {

namespace {

// In chunks. A step changes liquid and deficit within one chunk: liquid moves by at most kMaxTrace cells, its
// narrow band is little wider, and stencils reach a leaf farther. One chunk more is made at once, to last for
// many steps.
constexpr int kNeeded = 1, kMade = 2;

bool everySide(Side) {
  return true;
}

bool isNoMirror(Side side) {
  return side != Side::symmetry;
}

// The shape of a mesh sequence between two files. part: from `file` to the next, 0 to 1.
ShapeDistance shapeAt(const MovingMesh& mesh, int file, double part, const Solid& solid,
                      const Options& options) {
  try {
    return ShapeDistance(mesh.at(file, part), options.voxelSize(), reachOf(solid, domainBox(options)));
  } catch (const std::runtime_error& error) {
    throw MeshError(std::get<MeshSequence>(solid.shape.kind).fileOf(file).string() + ": " + error.what());
  }
}

}  // namespace

SolidField atRest(const SolidField& solid) {
  SolidField still = solid;
  still.speed = {};
  for (FloatGrid::Ptr& given : still.given.component) {
    if (given == nullptr) continue;
    given = given->deepCopy();
    for (auto it = given->beginValueOn(); it; ++it) it.setValue(0.0f);
  }
  return still;
}

Solids::Solids(const Options& options) : m_options(options), m_domain(domainCells(options)) {
  const double h = m_options.voxelSize();
  for (const Solid& solid : m_options.solids) {
    m_shapes.emplace_back();
    m_sequences.emplace_back();
    if (const auto* sequence = std::get_if<MeshSequence>(&solid.shape.kind)) {
      MovingMesh mesh(*sequence);
      const ShapeDistance first = shapeAt(mesh, 0, 0.0, solid, m_options);
      m_sequences.back() = {std::move(mesh), 0, 0.0, first};
    } else {
      const openvdb::BBoxd domain = domainBox(m_options);
      m_shapes.back().emplace(solid.shape, h, domain, reachOf(solid, domain));
    }
  }
  for (int side = 0; side < 6; ++side) {
    if (m_options.sides[side] == Side::wall) m_walls[side] = m_options.wallOf(side);
  }
}

std::vector<std::size_t> Solids::active(double t) const {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < m_options.solids.size(); ++i) {
    if (m_options.solids[i].from <= t && t < m_options.solids[i].until) indices.push_back(i);
  }
  return indices;
}

double Solids::nextChange(double t) const {
  double next = kForever;
  const auto consider = [&](double change) {
    if (change > t) next = std::min(next, change);
  };
  for (const Solid& solid : m_options.solids) {
    if (solid.from >= solid.until) continue;
    consider(solid.from);
    consider(solid.until);
    for (const Keyframe& key : solid.keyframes) consider(key.time);
    if (const auto* sequence = std::get_if<MeshSequence>(&solid.shape.kind)) {
      // The files before and after t.
      const int last = sequence->count() - 1;
      const double file = std::clamp((t - sequence->start) * sequence->frameRate, 0.0, double(last));
      const int before = static_cast<int>(file);
      for (int n = before; n <= std::min(before + 2, last); ++n) consider(sequence->timeOf(n));
    }
  }
  return next;
}

Solids::Placed Solids::placed(std::size_t index, double t) const {
  const Pose pose = poseAt(m_options.solids[index], t);
  if (m_shapes[index]) return {index, pose, *m_shapes[index]};
  const std::scoped_lock lock(m_sequencesInUse);
  Sequence& sequence = *m_sequences[index];
  if (sequence.file != pose.file || sequence.part != pose.part) {
    sequence.shape = shapeAt(sequence.mesh, pose.file, pose.part, m_options.solids[index], m_options);
    sequence.file = pose.file;
    sequence.part = pose.part;
  }
  return {index, pose, sequence.shape};
}

std::vector<Solids::Placed> Solids::placed(double t, const std::vector<std::size_t>& set) const {
  std::vector<Placed> solids;
  solids.reserve(set.size());
  for (const std::size_t i : set) solids.push_back(placed(i, t));
  return solids;
}

double Solids::distanceTo(const Placed& solid, const Vec3d& x) const {
  return solid.shape(solid.pose.toBody(x));
}

double Solids::lastFace(int axis) const {
  const double h = m_options.voxelSize();
  return cellCount(m_options.size, h)[axis] * h;
}

Vec3d Solids::mirrored(Vec3d x) const {
  for (int a = 0; a < 3; ++a) {
    if (m_options.sides[2 * a] == Side::symmetry) x[a] = std::abs(x[a]);
    if (m_options.sides[2 * a + 1] == Side::symmetry) x[a] = std::min(x[a], 2.0 * lastFace(a) - x[a]);
  }
  return x;
}

// The place of a high side along its axis, metres.
double Solids::sideAt(int side) const {
  // A side that is not a wall lies in the plane of faces. A wall lies nowhere beyond that plane, by rounding
  // either.
  const double last = lastFace(side / 2);
  return m_options.sides[side] == Side::wall ? std::min(m_options.size[side / 2], last) : last;
}

double Solids::sideDistance(const Vec3d& x, SideSet counts) const {
  double distance = kForever, outside = 0.0;
  for (int side = 0; side < 6; ++side) {
    if (m_options.sides[side] == Side::unbounded || !counts(m_options.sides[side])) continue;
    const int a = side / 2;
    const double d = side % 2 == 0 ? x[a] : sideAt(side) - x[a];
    distance = std::min(distance, d);
    if (d < 0.0) outside += d * d;
  }
  // Outside, which is solid, the distance to the domain's box.
  return outside > 0.0 ? -std::sqrt(outside) : distance;
}

double Solids::distanceTo(const std::vector<Placed>& solids, const Vec3d& x, SideSet counts) const {
  const double toSide = sideDistance(x, counts);
  // Behind a side a solid continues as it is at the side: how far it reaches out there in the scene does not
  // tell how deep the place is.
  Vec3d place = x;
  for (int side = 0; side < 6 && toSide < 0.0; ++side) {
    if (m_options.sides[side] == Side::unbounded || !counts(m_options.sides[side])) continue;
    const int a = side / 2;
    place[a] = side % 2 == 0 ? std::max(place[a], 0.0) : std::min(place[a], sideAt(side));
  }
  double toSolid = kForever;
  for (const Placed& solid : solids) toSolid = std::min(toSolid, distanceTo(solid, place));
  if (toSide < 0.0 && toSolid < 0.0) return -std::hypot(toSide, toSolid);
  return std::min(toSide, toSolid);
}

const Wall& Solids::nearestWall(const std::vector<Placed>& solids, const Vec3d& x) const {
  double nearest = kForever;
  const Wall* wall = nullptr;
  const auto offer = [&](double distance, const Wall& candidate) {
    if (distance < nearest) {
      nearest = distance;
      wall = &candidate;
    }
  };
  for (int side = 0; side < 6; ++side) {
    if (m_options.sides[side] == Side::unbounded) continue;
    const double at = x[side / 2];
    offer(side % 2 == 0 ? at : m_options.size[side / 2] - at, m_walls[side]);
  }
  for (const Placed& solid : solids) offer(distanceTo(solid, x), m_options.solids[solid.index].wall);
  return *wall;
}

double Solids::distance(const Vec3d& x, double t) const {
  return distanceAt(t)(x);
}

std::function<double(const Vec3d&)> Solids::distanceAt(double t) const {
  return [this, solids = placed(t, active(t))](const Vec3d& x) { return distanceTo(solids, x, everySide); };
}

// The solid's velocity at a place. distance: from the solid to it. change: velocity of its shape, null where
// that is rigid.
Vec3d Solids::velocityOf(const Placed& solid, const SurfaceVelocity* change, const Vec3d& x,
                         double distance) const {
  const Vec3d velocity = solid.pose.velocityAt(x);
  // Deeper values are never used, and the closest point, one of many equally near, would take long to find.
  const double h = m_options.voxelSize(), deepest = (kSolidBand + 2) * h;
  if (change == nullptr || std::abs(distance) > deepest) return velocity;
  const double reach = std::abs(distance) + h;
  return velocity + solid.pose.directionToWorld(change->at(solid.pose.toBody(x), reach));
}

// Sets the faces of every leaf near a moving solid to the velocity of the nearest solid; 0 where a side of
// the domain is nearer.
void Solids::addSpeeds(SolidField& field, const std::vector<Placed>& solids) const {
  const double h = field.voxelSize;
  const double radius = (0.5 * std::sqrt(3.0) * kLeafDim + kSolidBand + 1.0) * h;
  const auto near = [&](const Coord& origin) {
    const Vec3d middle((origin[0] + 4) * h, (origin[1] + 4) * h, (origin[2] + 4) * h);
    return std::any_of(solids.begin(), solids.end(), [&](const Placed& solid) {
      return solid.pose.moving() && std::abs(distanceTo(solid, middle)) < radius;
    });
  };
  std::vector<std::optional<SurfaceVelocity>> changes(solids.size());
  for (std::size_t i = 0; i < solids.size(); ++i) {
    const Pose& pose = solids[i].pose;
    if (pose.fileRate == 0.0) continue;
    const MovingMesh& mesh = m_sequences[solids[i].index]->mesh;
    std::vector<openvdb::Vec3f> velocity = mesh.change(pose.file);
    for (openvdb::Vec3f& v : velocity) v *= static_cast<float>(pose.fileRate);
    changes[i].emplace(mesh.at(pose.file, pose.part), std::move(velocity));
  }
  std::vector<Coord> origins;
  for (auto leaf = field.phi->constTree().cbeginLeaf(); leaf; ++leaf)
    if (near(leaf->origin())) origins.push_back(leaf->origin());
  for (int axis = 0; axis < 3; ++axis) {
    FloatGrid::Ptr grid = FloatGrid::create(0.0f);
    grid->setTransform(faceTransform(h, axis));
    std::vector<FloatLeaf*> leaves;
    leaves.reserve(origins.size());
    for (const Coord& origin : origins) leaves.push_back(grid->tree().touchLeaf(origin));
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      for (int c = 0; c < kLeafSize; ++c) {
        const Vec3d x = grid->indexToWorld(leaves[n]->offsetToGlobalCoord(c));
        double nearest = sideDistance(x, everySide);
        std::size_t by = solids.size();
        for (std::size_t i = 0; i < solids.size(); ++i) {
          const double d = distanceTo(solids[i], x);
          if (d >= nearest) continue;
          nearest = d;
          by = i;
        }
        const double speed =
            by == solids.size()
                ? 0.0
                : velocityOf(solids[by], changes[by] ? &*changes[by] : nullptr, x, nearest)[axis];
        leaves[n]->setValueOn(c, static_cast<float>(speed));
      }
    });
    field.speed.component[axis] = grid;
  }
}

SolidField Solids::fieldOf(const std::vector<Placed>& solids, Chunks chunks) const {
  const auto distance = [&](const Vec3d& x) { return distanceTo(solids, x, everySide); };
  const auto openDistance = [&](const Vec3d& x) { return distanceTo(solids, x, isClosed); };
  const auto mirroredDistance = [&](const Vec3d& x) { return distanceTo(solids, mirrored(x), isNoMirror); };
  const bool mirrors =
      std::find(m_options.sides.begin(), m_options.sides.end(), Side::symmetry) != m_options.sides.end();
  SolidField field =
      makeSolidField(distance, openDistance, mirrors ? SolidDistance(mirroredDistance) : SolidDistance(),
                     m_domain, std::move(chunks), m_options.voxelSize());
  field.sides = m_options.sides;
  if (std::any_of(solids.begin(), solids.end(), [](const Placed& solid) { return solid.pose.moving(); }))
    addSpeeds(field, solids);
  const bool grip = std::any_of(m_walls.begin(), m_walls.end(), grips) ||
                    std::any_of(solids.begin(), solids.end(), [&](const Placed& solid) {
                      return grips(m_options.solids[solid.index].wall);
                    });
  if (grip)
    setWalls(
        field, [&](const Vec3d& x) -> const Wall& { return nearestWall(solids, x); }, distance);
  return field;
}

std::shared_ptr<const SolidField> Solids::at(double t) {
  const auto solids = placed(t, active(t));
  const CoordBBox cells = firstCells(cellCount(m_options.size, m_options.voxelSize()));
  const Chunks whole = chunksIn(grown(cells, kSolidMargin));
  if (m_cached == nullptr || solids != m_cachedSet || !covers(m_cached->chunks, whole)) {
    m_cached = std::make_shared<SolidField>(fieldOf(solids, whole));
    m_cachedSet = solids;
  }
  return m_cached;
}

// Chunks around moving solids: their speed limits the step, wherever the liquid is.
Chunks Solids::movingChunks(const std::vector<Placed>& solids, const CoordBBox& box) const {
  Chunks chunks;
  for (const Placed& solid : solids) {
    if (!solid.pose.moving()) continue;
    const openvdb::BBoxd bounds = boundsAt(solid.shape.boundsIn(kEverywhere), solid.pose);
    CoordBBox near = grown(cellsIn(bounds, m_options.voxelSize()), 2 * kLeafDim);
    near.intersect(box);
    if (!near.empty() && !isEndless(near)) chunks = united(std::move(chunks), chunksIn(near));
  }
  return chunks;
}

std::shared_ptr<const SolidField> Solids::around(const std::vector<const FloatGrid*>& phis, double t,
                                                 const std::vector<std::size_t>& set) {
  const auto solids = placed(t, set);
  const CoordBBox box = grown(m_domain, kSolidMargin);
  const Chunks moving = movingChunks(solids, box);
  if (m_cached == nullptr || solids != m_cachedSet ||
      !covers(m_cached->chunks, united(chunksAround(phis, kNeeded, box), moving))) {
    m_cached = std::make_shared<SolidField>(fieldOf(solids, united(chunksAround(phis, kMade, box), moving)));
    m_cachedSet = solids;
  }
  return m_cached;
}

}  // namespace fluidtex::sim
