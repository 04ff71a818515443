// Based on Embree 3 [Wald14]. Which of two triangles a ray through their common edge hits depends on the
// structure. Embree's builder at medium quality (binned surface areas, no spatial splits) makes the same
// structure on any number of threads: it bins by counts and bounds alone, and sorts the triangles of a leaf.
// Higher quality, or a refitted scene, would have to be checked for that.
#include "render/embree_scene.h"

#include <embree3/rtcore.h>

#include <array>
#include <cstring>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>

namespace fluidtex::render {

struct EmbreeScene::Handles {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::uint32_t added = 0;

  ~Handles() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

namespace {

constexpr std::size_t kPacket = 8;

void check(RTCDevice device, const char* doing) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  throw std::runtime_error("ray tracing: error " + std::to_string(error) + " while " + doing);
}

RTCIntersectContext makeContext(Coherence coherence) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = coherence == Coherence::alike ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                                : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return context;
}

RTCRay makeRay(const Ray& ray) {
  RTCRay r{};
  r.org_x = ray.origin[0], r.org_y = ray.origin[1], r.org_z = ray.origin[2];
  r.dir_x = ray.direction[0], r.dir_y = ray.direction[1], r.dir_z = ray.direction[2];
  r.tfar = std::numeric_limits<float>::infinity();
  r.time = ray.time;
  r.mask = 0xffffffffu;
  return r;
}

void fillRay(RTCRay8& packet, std::size_t lane, const Ray& ray) {
  packet.org_x[lane] = ray.origin[0];
  packet.org_y[lane] = ray.origin[1];
  packet.org_z[lane] = ray.origin[2];
  packet.dir_x[lane] = ray.direction[0];
  packet.dir_y[lane] = ray.direction[1];
  packet.dir_z[lane] = ray.direction[2];
  packet.tnear[lane] = 0.0f;
  packet.tfar[lane] = std::numeric_limits<float>::infinity();
  packet.time[lane] = ray.time;
  packet.mask[lane] = 0xffffffffu;
  packet.id[lane] = 0;
  packet.flags[lane] = 0;
}

// Lanes beyond the last ray repeat it, so that all hold valid numbers; they are masked.
template <typename Body>
void forPackets(std::size_t count, const Body& body) {
  for (std::size_t first = 0; first < count; first += kPacket) {
    alignas(32) int valid[kPacket];
    const std::size_t lanes = std::min(kPacket, count - first);
    for (std::size_t lane = 0; lane < kPacket; ++lane) valid[lane] = lane < lanes ? -1 : 0;
    body(first, lanes, valid);
  }
}

}  // namespace

EmbreeScene::EmbreeScene() : m_handles(std::make_unique<Handles>()) {
  m_handles->device = rtcNewDevice(nullptr);
  if (!m_handles->device) {
    check(nullptr, "opening a device");
    throw std::runtime_error("ray tracing: no device could be opened");
  }
  m_handles->scene = rtcNewScene(m_handles->device);
  rtcSetSceneFlags(m_handles->scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(m_handles->scene, RTC_BUILD_QUALITY_MEDIUM);
  check(m_handles->device, "opening a scene");
}

EmbreeScene::~EmbreeScene() = default;

std::uint32_t EmbreeScene::add(const std::vector<Vec3f>& positions,
                               const std::vector<texture::Vec3I>& triangles) {
  return addMoments(std::array{&positions}, triangles);
}

std::uint32_t EmbreeScene::addMoving(const std::vector<Vec3f>& from, const std::vector<Vec3f>& to,
                                     const std::vector<texture::Vec3I>& triangles) {
  return addMoments(std::array{&from, &to}, triangles);
}

std::uint32_t EmbreeScene::addMoments(std::span<const std::vector<Vec3f>* const> moments,
                                      const std::vector<texture::Vec3I>& triangles) {
  const std::uint32_t number = m_handles->added++;
  if (triangles.empty()) return number;
  RTCDevice device = m_handles->device;
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetGeometryTimeStepCount(geometry, static_cast<unsigned>(moments.size()));
  bool complete = true;
  for (std::size_t moment = 0; moment < moments.size(); ++moment) {
    const std::vector<Vec3f>& positions = *moments[moment];
    void* buffer = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, static_cast<unsigned>(moment),
                                           RTC_FORMAT_FLOAT3, sizeof(Vec3f), positions.size());
    if (buffer)
      std::memcpy(buffer, positions.data(), positions.size() * sizeof(Vec3f));
    else
      complete = false;
  }
  void* indexBuffer = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              sizeof(texture::Vec3I), triangles.size());
  if (complete && indexBuffer) {
    std::memcpy(indexBuffer, triangles.data(), triangles.size() * sizeof(texture::Vec3I));
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(m_handles->scene, geometry, number);
  }
  rtcReleaseGeometry(geometry);
  check(device, "adding a mesh");
  return number;
}

void EmbreeScene::commit() {
  rtcJoinCommitScene(m_handles->scene);
  check(m_handles->device, "building a scene");
}

void EmbreeScene::intersect(std::span<Ray> rays, Coherence coherence) const {
  RTCIntersectContext context = makeContext(coherence);
  const auto store = [](Ray& ray, std::uint32_t geometry, std::uint32_t triangle, float u, float v) {
    if (geometry == RTC_INVALID_GEOMETRY_ID) {
      ray.geometry = ray.triangle = kNothing;
      return;
    }
    ray.geometry = geometry;
    ray.triangle = triangle;
    ray.u = u;
    ray.v = v;
  };
  if (coherence == Coherence::scattered) {
    for (Ray& ray : rays) {
      RTCRayHit query{};
      query.ray = makeRay(ray);
      query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(m_handles->scene, &context, &query);
      store(ray, query.hit.geomID, query.hit.primID, query.hit.u, query.hit.v);
    }
    return;
  }
  forPackets(rays.size(), [&](std::size_t first, std::size_t lanes, const int* valid) {
    RTCRayHit8 query;
    for (std::size_t lane = 0; lane < kPacket; ++lane) {
      fillRay(query.ray, lane, rays[first + std::min(lane, lanes - 1)]);
      query.hit.geomID[lane] = query.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect8(valid, m_handles->scene, &context, &query);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      store(rays[first + lane], query.hit.geomID[lane], query.hit.primID[lane], query.hit.u[lane],
            query.hit.v[lane]);
  });
}

void EmbreeScene::occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked,
                           Coherence coherence) const {
  RTCIntersectContext context = makeContext(coherence);
  // Embree marks an occluded ray by tfar = -infinity.
  if (coherence == Coherence::scattered) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      RTCRay query = makeRay(rays[i]);
      rtcOccluded1(m_handles->scene, &context, &query);
      blocked[i] = query.tfar < 0.0f;
    }
    return;
  }
  forPackets(rays.size(), [&](std::size_t first, std::size_t lanes, const int* valid) {
    RTCRay8 query;
    for (std::size_t lane = 0; lane < kPacket; ++lane)
      fillRay(query, lane, rays[first + std::min(lane, lanes - 1)]);
    rtcOccluded8(valid, m_handles->scene, &context, &query);
    for (std::size_t lane = 0; lane < lanes; ++lane) blocked[first + lane] = query.tfar[lane] < 0.0f;
  });
}

}  // namespace fluidtex::render
