// The triangle test follows Ericson: Real-Time Collision Detection (2005), sec. 5.1.5.
#include "tools/benchmarks/measure.h"
#include "tools/benchmarks/peers/closest_points.h"

#include <embree3/rtcore.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace fluidtex::benchmarks {
namespace {

using texture::Vec3f;
using texture::Vec3I;

struct Mesh {
  const std::vector<Vec3f>& positions;
  const std::vector<Vec3I>& triangles;
};

// Squared distance of p from triangle (0, ab, ac).
float squaredDistance(const Vec3f& p, const Vec3f& ab, const Vec3f& ac) {
  const auto toSegment = [](const Vec3f& x, const Vec3f& edge) {
    const float t = std::min(1.0f, std::max(0.0f, x.dot(edge) / edge.lengthSqr()));
    return (x - edge * t).lengthSqr();
  };
  const Vec3f n = ab.cross(ac);
  const bool inside =
      n.dot(ab.cross(p)) >= 0.0f && n.dot(p.cross(ac)) >= 0.0f && n.dot((ac - ab).cross(p - ab)) >= 0.0f;
  if (inside) return p.dot(n) * p.dot(n) / n.lengthSqr();
  return std::min({toSegment(p, ab), toSegment(p, ac), toSegment(p - ab, ac - ab)});
}

bool visit(RTCPointQueryFunctionArguments* arguments) {
  const Mesh& mesh = *static_cast<const Mesh*>(arguments->userPtr);
  const Vec3I& t = mesh.triangles[arguments->primID];
  const Vec3f a = mesh.positions[t[0]];
  const Vec3f p(arguments->query->x, arguments->query->y, arguments->query->z);
  const float distance =
      std::sqrt(squaredDistance(p - a, mesh.positions[t[1]] - a, mesh.positions[t[2]] - a));
  if (distance >= arguments->query->radius) return false;
  arguments->query->radius = distance;
  return true;
}

}  // namespace

ClosestRun embreeClosest(const std::vector<Vec3f>& positions, const std::vector<Vec3I>& triangles,
                         const std::vector<Vec3f>& queries) {
  Mesh mesh{positions, triangles};
  ClosestRun run;
  double from = processorSeconds();
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = rtcNewScene(device);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* points = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                         sizeof(Vec3f), positions.size());
  void* corners = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Vec3I),
                                          triangles.size());
  std::memcpy(points, positions.data(), positions.size() * sizeof(Vec3f));
  std::memcpy(corners, triangles.data(), triangles.size() * sizeof(Vec3I));
  rtcSetGeometryPointQueryFunction(geometry, visit);
  rtcSetGeometryUserData(geometry, &mesh);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  run.build = processorSeconds() - from;
  from = processorSeconds();
  for (const Vec3f& q : queries) {
    RTCPointQuery query{q.x(), q.y(), q.z(), 0.0f, std::numeric_limits<float>::infinity()};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene, &query, &context, nullptr, &mesh);
    run.sum += query.radius;
  }
  run.query = processorSeconds() - from;
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
  return run;
}

}  // namespace fluidtex::benchmarks
