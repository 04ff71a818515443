#include "render/embree_scene.h"
#include "render/sampling.h"
#include "shapes.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <catch2/catch.hpp>

using namespace fluidtex::render;

namespace {

std::vector<Ray> raysTowards(const Vec3f& from, int count) {
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    const Vec2f u = PixelSamples(i, 0, 1, 1).point(0, 0);
    const Vec3f to(2.0f * u[0] - 1.0f, 2.0f * u[1] - 1.0f, 0.0f);
    rays.push_back({from, normalized(to - from)});
  }
  return rays;
}

}  // namespace

TEST_CASE("embree scene: hits are where the triangles are", "[render]") {
  EmbreeScene scene;
  const Solid square = shapes::square(-0.5f, 0.5f, 0.0f, Vec3d(1.0));
  REQUIRE(scene.add({}, {}) == 0);
  REQUIRE(scene.add(square.positions, square.triangles) == 1);
  scene.commit();
  std::vector<Ray> rays = raysTowards(Vec3f(0.1f, -0.2f, 3.0f), 1003);
  scene.intersect(rays, Coherence::alike);
  int hits = 0;
  for (const Ray& ray : rays) {
    const Vec3f at = ray.origin - ray.direction * (ray.origin[2] / ray.direction[2]);
    const float edge = std::max(std::abs(at[0]), std::abs(at[1]));
    if (std::abs(edge - 0.5f) < 1e-5f) continue;
    REQUIRE(ray.hit() == (edge < 0.5f));
    if (!ray.hit()) continue;
    ++hits;
    REQUIRE(ray.geometry == 1);
    const auto& t = square.triangles[ray.triangle];
    const Vec3f p = square.positions[t[0]] * (1.0f - ray.u - ray.v) + square.positions[t[1]] * ray.u +
                    square.positions[t[2]] * ray.v;
    REQUIRE((p - at).length() < 1e-5f);
  }
  REQUIRE(hits > 150);
}

TEST_CASE("embree scene: rays traced together and alone agree, for hits and for shadows", "[render]") {
  const auto ball = shapes::sphere(Vec3f(0.0f), 0.6f, 3, Vec4f(1.0f));
  EmbreeScene scene;
  scene.add(ball.positions, ball.triangles);
  scene.commit();
  for (const int count : {1, 7, 8, 9, 500}) {
    std::vector<Ray> together = raysTowards(Vec3f(0.3f, 0.2f, 2.0f), count), alone = together;
    std::vector<std::uint8_t> blockedTogether(count), blockedAlone(count);
    scene.occluded(together, blockedTogether, Coherence::alike);
    scene.occluded(alone, blockedAlone, Coherence::scattered);
    scene.intersect(together, Coherence::alike);
    scene.intersect(alone, Coherence::scattered);
    for (int i = 0; i < count; ++i) {
      REQUIRE(together[i].hit() == alone[i].hit());
      REQUIRE(together[i].triangle == alone[i].triangle);
      REQUIRE(static_cast<bool>(blockedTogether[i]) == together[i].hit());
      REQUIRE(blockedTogether[i] == blockedAlone[i]);
    }
  }
}

TEST_CASE("embree scene: a closed mesh has no cracks along its edges", "[render]") {
  const auto ball = shapes::sphere(Vec3f(0.0f), 1.0f, 4, Vec4f(1.0f));
  EmbreeScene scene;
  scene.add(ball.positions, ball.triangles);
  scene.commit();
  std::vector<Ray> rays;  // from the middle
  for (std::size_t i = 0; i < ball.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const Vec3f &a = ball.positions[ball.triangles[i][k]],
                  &b = ball.positions[ball.triangles[i][(k + 1) % 3]];
      const float share = 0.05f + 0.9f * PixelSamples(static_cast<int>(i), k, 1, 1).point(0, 0)[0];
      rays.push_back({Vec3f(0.0f), normalized(a * share + b * (1.0f - share))});
    }
  for (const Coherence coherence : {Coherence::alike, Coherence::scattered}) {
    scene.intersect(rays, coherence);
    REQUIRE(std::count_if(rays.begin(), rays.end(), [](const Ray& ray) { return !ray.hit(); }) == 0);
  }
}

TEST_CASE("embree scene: an empty scene blocks nothing", "[render]") {
  EmbreeScene scene;
  scene.commit();
  std::vector<Ray> rays = raysTowards(Vec3f(0.0f, 0.0f, 1.0f), 9);
  scene.intersect(rays, Coherence::alike);
  for (const Ray& ray : rays) REQUIRE_FALSE(ray.hit());
}

TEST_CASE("embree: a moving mesh is where it is at the ray's time, others stand", "[render]") {
  const std::vector<Vec3f> low{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}, high{{-1, -1, 4}, {1, -1, 4}, {0, 1, 4}};
  const std::vector<Vec3f> wall{{5, -1, -9}, {5, 1, -9}, {5, 0, 9}};
  const std::vector<texture::Vec3I> triangle{{0, 1, 2}};
  EmbreeScene scene;
  const std::uint32_t moving = scene.addMoving(low, high, triangle), standing = scene.add(wall, triangle);
  scene.commit();
  for (const float time : {0.0f, 0.25f, 0.9f})
    for (const Coherence coherence : {Coherence::alike, Coherence::scattered}) {
      // Along x just below and just above where the triangle is: only from above to below it is met.
      Ray down{Vec3f(0.0f, 0.0f, 4.0f * time + 0.1f), Vec3f(0.0f, 0.0f, -1.0f)};
      Ray below{Vec3f(0.0f, 0.0f, 4.0f * time - 0.1f), Vec3f(0.0f, 0.0f, -1.0f)};
      Ray aside{Vec3f(0.0f), Vec3f(1.0f, 0.0f, 0.0f)};
      std::vector<Ray> rays{down, below, aside};
      for (Ray& ray : rays) ray.time = time;
      scene.intersect(rays, coherence);
      CHECK(rays[0].geometry == moving);
      CHECK_FALSE(rays[1].hit());
      CHECK(rays[2].geometry == standing);
    }
}

TEST_CASE(
    "embree scene: which triangle is met on a common edge or corner is the same on any number of threads",
    "[render]") {
  const tbb::global_control many(tbb::global_control::max_allowed_parallelism, 8);
  // Large enough that its triangles are sorted into the structure by all threads.
  const auto ball = shapes::sphere(Vec3f(0.0f), 1.0f, 6, Vec4f(1.0f));
  REQUIRE(ball.triangles.size() > 50000);
  std::vector<Ray> rays;
  for (const Vec3f& corner : ball.positions) rays.push_back({corner * 3.0f, -corner});
  for (const auto& t : ball.triangles) {
    const Vec3f middle = (ball.positions[t[0]] + ball.positions[t[1]]) * 0.5f;
    rays.push_back({middle * 3.0f, -middle});
  }
  const auto metIn = [&](const std::vector<fluidtex::texture::Vec3I>& mesh, int threads, int run) {
    EmbreeScene scene;
    scene.add(ball.positions, mesh);
    tbb::task_arena arena(threads);
    arena.execute([&] { scene.commit(); });
    std::vector<Ray> traced = rays;
    scene.intersect(traced, run % 2 == 0 ? Coherence::alike : Coherence::scattered);
    std::vector<std::uint32_t> triangles;
    for (const Ray& ray : traced) triangles.push_back(ray.triangle);
    return triangles;
  };
  const auto met = [&](int threads, int run) { return metIn(ball.triangles, threads, run); };
  const auto alike = met(1, 0), scattered = met(1, 1);
  // The order matters indeed: from back to front, other triangles are met.
  const auto count = static_cast<std::uint32_t>(ball.triangles.size());
  const auto backwards = metIn({ball.triangles.rbegin(), ball.triangles.rend()}, 1, 0);
  int others = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) others += count - 1 - backwards[i] != alike[i];
  REQUIRE(others > 100);
  for (const int threads : {2, 3, 8})
    for (int run = 0; run < 4; ++run) {
      INFO(threads << " threads");
      REQUIRE((met(threads, run) == (run % 2 == 0 ? alike : scattered)));
    }
}
