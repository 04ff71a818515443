#include "texture/joints/joints.h"

#include "tests/texture/joints/sheets.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>

#include <cstring>
#include <map>
#include <set>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

namespace {

const Piece kStraight{{10.0f, 10.0f}, {{10.0f, 0.0f, 0.0f}, {0.0f, 10.0f, 0.0f}}};
const Piece kTurned{{40.0f, 20.0f}, {{0.0f, -8.0f, 0.0f}, {12.0f, 3.0f, 0.0f}}};
const Piece kMirrored{{25.0f, 30.0f}, {{-10.0f, 0.0f, 0.0f}, {0.0f, 10.0f, 0.0f}}};

// Whether two coordinates are the same but for repetitions of the exemplar.
bool isSame(const TexturedSurface& surface, const Vec2f& a, const Vec2f& b) {
  return (Torus(surface, true).unwrapped(a, b) - b).length() < 1e-3f;
}

bool isClose(const Vec2f& a, const Vec2f& b) {
  return (a - b).length() < 1e-3f;
}

}  // namespace

TEST_CASE("joints: one piece has none") {
  TexturedSurface sheet = flatSheet(5);
  layPieces(
      {kTurned}, [](const Vec3f&) { return 0; }, false, sheet);
  CHECK(findJoints(sheet, false).joints.empty());
  CHECK(findJoints(sheet, true).joints.empty());
  sheet.coordinate.clear();
  CHECK(findJoints(sheet, true).joints.empty());
}

TEST_CASE("joints: a piece across the edge of a toroidal exemplar has three equal labels without a jump") {
  TexturedSurface sheet = flatSheet(12);
  const Piece piece{{58.0f, 42.0f}, {{10.0f, 2.0f, 0.0f}, {-1.0f, 11.0f, 0.0f}}};
  layPieces(
      {piece}, [](const Vec3f&) { return 0; }, true, sheet);
  const Joints found = findJoints(sheet, true);
  std::set<std::uint32_t> wrapped;
  for (const Joint& joint : found.joints) {
    wrapped.insert(joint.triangle);
    const Vec3I& corner = sheet.triangles[joint.triangle];
    for (std::size_t label = 0; label < 3; ++label) {
      CHECK(joint.shown[label][label] == sheet.coordinate[corner[int(label)]]);
      for (std::size_t c = 0; c < 3; ++c) {
        // The differences along the triangle are those of the linear function.
        const Vec3f way = sheet.positions[corner[int(c)]] - sheet.positions[corner[int(label)]];
        CHECK(isClose(joint.shown[label][c], continued(joint.shown[label][label], piece.gradient, way)));
      }
    }
    CHECK(joint.former == joint.shown);
  }
  for (std::uint32_t t = 0; t < sheet.triangles.size(); ++t) {
    bool far = false;
    for (int k = 0; k < 3; ++k) {
      const Vec2f d =
          sheet.coordinate[sheet.triangles[t][k]] - sheet.coordinate[sheet.triangles[t][(k + 1) % 3]];
      far = far || std::abs(d[0]) > 32.0f || std::abs(d[1]) > 24.0f;
    }
    CHECK(far == (wrapped.count(t) == 1));
  }
  CHECK_FALSE(wrapped.empty());
  // Without repetitions the same coordinates are two pieces.
  for (const Joint& joint : findJoints(sheet, false).joints) CHECK(wrapped.count(joint.triangle) == 1);
}

TEST_CASE("joints: each label is its piece's own linear function at all corners") {
  const bool toroidal = GENERATE(false, true);
  const std::size_t count = GENERATE(std::size_t(2), std::size_t(3));
  const std::vector<Piece> pieces{kStraight, kTurned, kMirrored};
  const auto which = [&](const Vec3f& x) {
    return x.x() < 0.45f ? std::size_t(0) : x.y() < 0.45f ? std::size_t(1) : count - 1;
  };
  TexturedSurface sheet = flatSheet(10);
  layPieces(pieces, which, toroidal, sheet);
  const Joints found = findJoints(sheet, toroidal);
  std::size_t next = 0, ofThree = 0;
  for (std::uint32_t t = 0; t < sheet.triangles.size(); ++t) {
    const Vec3I& corner = sheet.triangles[t];
    std::set<std::size_t> around;
    for (int k = 0; k < 3; ++k) around.insert(which(sheet.positions[corner[k]]));
    const Joint* joint = jointIn(found, t);
    if (around.size() == 1) {
      if (joint) CHECK(toroidal);  // across the exemplar's edge
      continue;
    }
    REQUIRE(joint);
    CHECK(joint->triangle == t);
    ofThree += around.size() == 3;
    for (std::size_t label = 0; label < 3; ++label) {
      const Piece& piece = pieces[which(sheet.positions[corner[int(label)]])];
      for (std::size_t c = 0; c < 3; ++c) {
        const Vec2f exact = piece.at(sheet.positions[corner[int(c)]]);
        CHECK((toroidal ? isSame(sheet, joint->shown[label][c], exact)
                        : isClose(joint->shown[label][c], exact)));
      }
    }
  }
  for (const Joint& joint : found.joints) {
    CHECK((next == 0 || found.joints[next - 1].triangle < joint.triangle));
    ++next;
  }
  CHECK(ofThree == (count == 3 ? 1 : 0));
}

TEST_CASE("joints: neighbours of what fades take its former piece, and only what fades has joints of it") {
  TexturedSurface sheet = flatSheet(9);
  layPieces(
      {kStraight}, [](const Vec3f&) { return 0; }, false, sheet);
  const auto leave = [&](std::uint32_t v, const Piece& piece, float weight) {
    sheet.fading.coordinate[v] = piece.at(sheet.positions[v]);
    sheet.fading.gradient[v] = piece.gradient;
    sheet.fading.weight[v] = weight;
  };
  // One vertex fades: its triangles are of one piece, as all its neighbours take its own.
  const std::uint32_t middle = 4 * 9 + 4;
  leave(middle, kTurned, 0.5f);
  const Joints alone = findJoints(sheet, false);
  CHECK(alone.joints.empty());
  for (std::uint32_t v = 0; v < sheet.positions.size(); ++v) {
    const Vec3f way = sheet.positions[v] - sheet.positions[middle];
    const bool near = std::abs(way.x()) < 0.15f && std::abs(way.y()) < 0.15f && way.x() * way.y() > -0.001f;
    CHECK(bool(alone.former.known[v]) == near);
    CHECK(isClose(alone.former.places.coordinate[v], (near ? kTurned : kStraight).at(sheet.positions[v])));
  }
  // Its neighbour to the right fades from another piece: the two triangles at that edge are of both, and so
  // are those between them and vertices that take the stronger one.
  leave(middle + 1, kMirrored, 0.7f);
  const Joints two = findJoints(sheet, false);
  std::set<std::uint32_t> joints;
  for (const Joint& joint : two.joints) {
    joints.insert(joint.triangle);
    const Vec3I& corner = sheet.triangles[joint.triangle];
    bool fades = false;
    for (int k = 0; k < 3; ++k) fades = fades || sheet.fading.weight[corner[k]] > 0.0f;
    CHECK(fades);
    for (std::size_t label = 0; label < 3; ++label)
      for (std::size_t c = 0; c < 3; ++c) {
        CHECK(isClose(joint.shown[label][c], kStraight.at(sheet.positions[corner[int(c)]])));
        const Piece& piece = corner[int(label)] == middle ? kTurned : kMirrored;
        const Piece& taken = isClose(two.former.places.coordinate[corner[int(label)]],
                                     kTurned.at(sheet.positions[corner[int(label)]]))
                                 ? kTurned
                                 : piece;
        CHECK(isClose(joint.former[label][c], taken.at(sheet.positions[corner[int(c)]])));
      }
  }
  for (std::uint32_t t = 0; t < sheet.triangles.size(); ++t) {
    const Vec3I& corner = sheet.triangles[t];
    int has = 0;
    for (int k = 0; k < 3; ++k) has += corner[k] == middle || corner[k] == middle + 1;
    if (has == 2) CHECK(joints.count(t) == 1);
  }
}

TEST_CASE("joints: what is mixed on an edge is the same from both of its triangles") {
  const TexturedSurface torus = patchedTorus(40, 5);
  const Joints found = findJoints(torus, true);
  CHECK(found.joints.size() > 100);
  CHECK(found.joints.size() < torus.triangles.size());
  // Labels of an edge's ends, at its ends, by the edge.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<Vec2f, 4>> seen;
  std::size_t shared = 0;
  for (const Joint& joint : found.joints) {
    const Vec3I& corner = torus.triangles[joint.triangle];
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3;
      const auto a = std::size_t(corner[k] < corner[l] ? k : l),
                 b = std::size_t(corner[k] < corner[l] ? l : k);
      const std::array<Vec2f, 4> labels{joint.shown[a][a], joint.shown[a][b], joint.shown[b][a],
                                        joint.shown[b][b]};
      const auto [place, isNew] = seen.insert({{corner[int(a)], corner[int(b)]}, labels});
      if (isNew) continue;
      ++shared;
      CHECK(place->second == labels);
    }
  }
  CHECK(shared > 50);
}

TEST_CASE("joints: the same on any number of threads") {
  const TexturedSurface torus = patchedTorus(60, 3);
  const Joints one = onThreads(1, [&] { return findJoints(torus, true); });
  const Joints many = onThreads(7, [&] { return findJoints(torus, true); });
  REQUIRE(one.joints.size() == many.joints.size());
  CHECK(std::memcmp(one.joints.data(), many.joints.data(), one.joints.size() * sizeof(Joint)) == 0);
  CHECK(one.former.places.coordinate == many.former.places.coordinate);
}
