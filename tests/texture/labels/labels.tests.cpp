#include "texture/labels/labels.h"

#include "tests/texture/exemplar/test_images.h"
#include "tests/texture/orientation/oriented_mesh.h"
#include "texture/loops/complex.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <set>

using namespace fluidtex::texture;
using namespace fluidtex::testing;
using fluidtex::randomUnit;

TEST_CASE("labels: stretch is the worse of the singular values") {
  const float c = std::cos(0.7f), s = std::sin(0.7f);
  const auto turned = [&](float a, float b) {  // rotation times diag(a, b)
    return Label{{0, 0}, {c * a, -s * b, s * a, c * b}};
  };
  CHECK(stretch(turned(1, 1)) == Approx(1.0f));
  CHECK(stretch(turned(1.5f, 1)) == Approx(1.5f));
  CHECK(stretch(turned(0.5f, 1.5f)) == Approx(2.0f));
  CHECK(stretch(turned(3, 0.5f)) == Approx(3.0f));
  CHECK(stretch(turned(1, -1)) == Approx(1.0f));  // mirrored
  CHECK(stretch(turned(1, 0)) > 100.0f);
  CHECK(stretch(Label{{0, 0}, {NAN, 0, 0, 1}}) > 100.0f);
  CHECK(stretch(unstretched({3, 4}, {Complexf(c, s)})) == Approx(1.0f));
}

TEST_CASE("labels: a gradient is stretched as its label is") {
  const OrientedMesh surface = orientedMesh(sphereMesh(3));
  for (std::uint32_t v = 0; v < surface.mesh.positions.size(); ++v) {
    const auto r = [&](int i) { return 2.0f * float(randomUnit(6, 4 * v + std::uint64_t(i))) - 1.0f; };
    const Label label{{0, 0}, {1.0f + r(0), r(1), r(2), 1.0f + r(3)}};
    const TexelGradient gradient =
        gradientOf(label, surface.mesh.orientation[v], surface.mesh.normals[v], surface.mesh.spacing);
    if (stretch(label) < 100.0f)
      CHECK(stretch(gradient, surface.mesh.spacing) == Approx(stretch(label)).epsilon(0.02));
  }
  CHECK(stretch(TexelGradient{}, 0.1) == 1000.0f);
}

TEST_CASE("labels: gradients in space and back") {
  const OrientedMesh surface = orientedMesh(sphereMesh(6));
  std::vector<Vec2f> coordinate;
  std::vector<TexelGradient> gradient;
  Labels labels;
  for (std::uint32_t v = 0; v < surface.mesh.positions.size(); ++v) {
    const auto r = [&](int i) { return float(randomUnit(5, 4 * v + std::uint64_t(i))) - 0.5f; };
    labels.push_back({{10.0f * r(0), 5.0f}, {1.0f + r(0), r(1), r(2), 1.0f + r(3)}});
    coordinate.push_back(labels[v].texel);
    gradient.push_back(
        gradientOf(labels[v], surface.mesh.orientation[v], surface.mesh.normals[v], surface.mesh.spacing));
    CHECK(std::abs(gradient[v].s.dot(surface.mesh.normals[v])) < 1e-4f / float(surface.mesh.spacing));
  }
  const Labels back = labelsOf(surface.mesh, coordinate, gradient);
  for (std::size_t v = 0; v < labels.size(); ++v) {
    CHECK(back[v].texel == labels[v].texel);
    for (int i = 0; i < 4; ++i) CHECK(back[v].jacobian[i] == Approx(labels[v].jacobian[i]).margin(1e-5));
  }
}

TEST_CASE("labels: the gradient says which texel lies one pixel further") {
  const OrientedMesh surface = flatBox(12);
  const std::uint32_t v = nearestVertex(surface.mesh, Vec3f(6, 6, 2));
  const Vec3f d = surface.mesh.orientation[v], n = surface.mesh.normals[v];
  const TexelGradient gradient = gradientOf(unstretched({20, 20}, {}), d, n, 1.0);
  // Columns run along d, rows along d x n.
  CHECK((gradient.s - d).length() < 1e-6f);
  CHECK((gradient.t - d.cross(n)).length() < 1e-6f);
}

TEST_CASE("labels: a label continued over an edge puts the same texel there") {
  OrientedMesh surface = flatBox(12);
  for (std::uint32_t v = 0; v < surface.mesh.positions.size(); ++v) {  // axes that turn from vertex to vertex
    const Vec3f &d = surface.mesh.orientation[v], b = rowAxis(d, surface.mesh.normals[v]);
    const float angle = 6.28f * float(randomUnit(1, v));
    surface.mesh.orientation[v] = d * std::cos(angle) + b * std::sin(angle);
  }
  surface = orientedMesh(surface.mesh);
  const TexelImage image = makeTexelImage(noiseImage(40, 40, 3, 1), false, 4);
  const std::uint32_t u = nearestVertex(surface.mesh, Vec3f(6, 6, 2));
  const Label label{{20, 20}, {1.2f, 0.1f, -0.3f, 0.9f}};
  const TexelGradient gradient = gradientOf(label, surface.mesh.orientation[u], surface.mesh.normals[u], 1.0);
  for (const std::uint32_t v : surface.graph.around(u)) {
    for (std::uint32_t h = surface.graph.first[v]; h < surface.graph.first[v + 1]; ++h) {
      if (surface.graph.neighbor[h] != u) continue;
      const Label there = continued(image, label, surface.connection.edge[h], surface.connection.rotation[h]);
      const Vec3f way = surface.mesh.positions[v] - surface.mesh.positions[u];
      CHECK((there.texel - label.texel - Vec2f(gradient.s.dot(way), gradient.t.dot(way))).length() < 1e-4f);
      const TexelGradient same = gradientOf(there, surface.mesh.orientation[v], surface.mesh.normals[v], 1.0);
      CHECK((same.s - gradient.s).length() < 1e-5f);
      CHECK((same.t - gradient.t).length() < 1e-5f);
    }
  }
}

TEST_CASE("labels: blocks are contiguous pieces of the exemplar") {
  const OrientedMesh surface = orientedMesh(torusMesh(160, 64));
  const TexelImage image = makeTexelImage(noiseImage(80, 70, 3, 1), false, 4);
  const Labels labels = blockLabels(surface.view(), image, 24.0f, 3);
  std::size_t edges = 0, whole = 0;
  for (std::uint32_t v = 0; v < labels.size(); ++v) {
    CHECK(stretch(labels[v]) == Approx(1.0f).margin(1e-4));
    CHECK((image.brought(labels[v].texel) - labels[v].texel).length() == 0.0f);
    for (std::uint32_t h = surface.graph.first[v]; h < surface.graph.first[v + 1]; ++h) {
      const Label other = continued(image, labels[surface.graph.neighbor[h]], surface.connection.edge[h],
                                    surface.connection.rotation[h]);
      ++edges;
      whole += texelDifference(image, other.texel, labels[v].texel).length() < kCoherent;
    }
  }
  CHECK(double(whole) > 0.8 * double(edges));  // the others lie between blocks of about 24 pixels
  const Labels again = blockLabels(surface.view(), image, 24.0f, 4);
  CHECK(again[0].texel != labels[0].texel);
}

TEST_CASE("labels: refining keeps the picture") {
  // The same plane at two spacings, axes turned against each other.
  OrientedMesh fine = flatBox(32);
  SurfaceMesh coarseMesh = boxMesh({0, 0, 0}, {32, 32, 2}, {16, 16, 1});
  coarseMesh.spacing = 2.0;
  coarseMesh.orientation = referenceVectors(coarseMesh.normals);
  for (std::uint32_t v = 0; v < coarseMesh.positions.size(); ++v) {
    const Vec3f &d = coarseMesh.orientation[v], b = rowAxis(d, coarseMesh.normals[v]);
    coarseMesh.orientation[v] = d * std::cos(0.1f * float(v)) + b * std::sin(0.1f * float(v));
  }
  const OrientedMesh coarse = orientedMesh(std::move(coarseMesh));
  const TexelImage image = makeTexelImage(noiseImage(200, 200, 3, 1), false, 4);
  // The fine picture: texel = (60 + x, 100 - y). The coarse one is half of it: texels 2i and 2i + 1 join to
  // i.
  Labels labels;
  for (std::uint32_t v = 0; v < coarse.mesh.positions.size(); ++v) {
    const Vec3f &x = coarse.mesh.positions[v], d = coarse.mesh.orientation[v],
                b = rowAxis(d, coarse.mesh.normals[v]);
    labels.push_back({{(59.5f + x.x()) / 2, (99.5f - x.y()) / 2}, {d.x(), b.x(), -d.y(), -b.y()}});
  }
  const Labels refined = refineLabels(coarse.mesh, labels, fine.mesh, image);
  for (std::uint32_t v = 0; v < fine.mesh.positions.size(); ++v) {
    const Vec3f& x = fine.mesh.positions[v];
    if (x.z() < 1.9f || x.x() < 2 || x.x() > 30 || x.y() < 2 || x.y() > 30) continue;
    CHECK((refined[v].texel - Vec2f(60 + x.x(), 100 - x.y())).length() < 1e-3f);
    CHECK(refined[v].jacobian[0] == Approx(1.0f).margin(1e-4));
    CHECK(refined[v].jacobian[1] == Approx(0.0f).margin(1e-4));
    CHECK(refined[v].jacobian[3] == Approx(1.0f).margin(1e-4));
  }
}

TEST_CASE("labels: on an exemplar that wraps, whole turns make no difference") {
  const TexelImage wrapping = makeTexelImage(noiseImage(40, 30, 3, 1), true, 4);
  const TexelImage ending = makeTexelImage(noiseImage(40, 30, 3, 1), false, 4);
  CHECK(texelDifference(wrapping, {39, 29}, {1, 1}) == Vec2f(-2, -2));
  CHECK(texelDifference(ending, {39, 29}, {1, 1}) == Vec2f(38, 28));
}

TEST_CASE("labels: what would lead off the exemplar is handed on from another side") {
  const OrientedMesh surface = flatBox(24);
  const TexelImage image = makeTexelImage(noiseImage(100, 100, 3, 1), false, 4);
  const std::size_t count = surface.mesh.positions.size();
  // A strip between a picture that ends at its left side and one that goes on at its right.
  Labels labels(count);
  std::vector<std::uint8_t> wanted, placed;
  for (std::uint32_t v = 0; v < count; ++v) {
    const Vec3f& x = surface.mesh.positions[v];
    const bool inside = x.z() > 1.9f && x.x() > 2 && x.x() < 22 && x.y() > 2 && x.y() < 22;
    const bool strip = inside && x.x() > 7.5f && x.x() < 14.5f;
    wanted.push_back(strip);
    placed.push_back(inside && !strip);
    labels[v] = unstretched(Vec2f(x.x() < 11 ? 91.6f + x.x() : 20 + x.x(), 60 - x.y()), {});
  }
  handOn(image, surface.view(), wanted, placed, labels, HandOn::inside);
  for (std::uint32_t v = 0; v < count; ++v)
    if (wanted[v]) CHECK(labels[v].texel[0] == Approx(20 + surface.mesh.positions[v].x()).margin(1e-3));
}
