#include "tools/formats/export_mesh.h"

#include "texture/joints/cut.h"
#include "texture/joints/joints.h"
#include "texture/labels/labels.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>

namespace fluidtex::tools {
namespace {

using texture::kNone;

bool sameRow(const std::vector<const Column*>& columns, std::uint32_t a, std::uint32_t b) {
  return std::all_of(columns.begin(), columns.end(), [=](const Column* column) {
    const auto size = static_cast<std::size_t>(column->components);
    const float* values = column->values.data();
    return std::equal(values + a * size, values + (a + 1) * size, values + b * size);
  });
}

// Zeros for kNone.
Column picked(const Column& from, const std::vector<std::uint32_t>& rows) {
  const auto size = static_cast<std::size_t>(from.components);
  Column to{from.name, from.components, std::vector<float>(rows.size() * size)};
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i] != kNone)
      std::copy_n(from.values.begin() + std::ptrdiff_t(rows[i] * size), size,
                  to.values.begin() + std::ptrdiff_t(i * size));
  return to;
}

template <typename T>
std::vector<T> picked(const std::vector<T>& from, const std::vector<std::uint32_t>& rows) {
  std::vector<T> to(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) to[i] = from[rows[i]];
  return to;
}

// Texels as shares of the exemplar's size.
struct Shares {
  float width, height;
  explicit Shares(const texture::TexturedSurface& surface)
      : width(float(std::max(surface.exemplarWidth, 1))),
        height(float(std::max(surface.exemplarHeight, 1))) {}
  texture::Vec2f operator()(const texture::Vec2f& texel) const {
    return {(texel[0] + 0.5f) / width, (texel[1] + 0.5f) / height};
  }
};

template <typename T>
Column column(std::string name, const std::vector<T>& values) {
  constexpr int kComponents = sizeof(T) / sizeof(float);
  const auto* floats = reinterpret_cast<const float*>(values.data());
  return {std::move(name), kComponents, {floats, floats + values.size() * kComponents}};
}

Column column(std::string name, const std::vector<std::uint8_t>& values) {
  return {std::move(name), 1, {values.begin(), values.end()}};
}

// The name of a map's column: NAME_ where the formats call something else by its name.
std::string nameOfMap(std::string name, const std::vector<Column>& columns) {
  static const std::set<std::string> kOwn = {"normal", "color", "displayColor", "displayOpacity", "joint"};
  while (kOwn.contains(name) || isUvSet(name) || findColumn(columns, name) != nullptr) name += "_";
  return name;
}

// Three maps become one column where they are the parts of a vector, of which files hold each by itself.
void addMaps(const texture::TexturedSurface& surface, std::vector<Column>& columns) {
  const auto& maps = surface.maps;
  std::set<std::string> done;
  for (const auto& [first, values] : maps) {
    if (done.contains(first)) continue;
    Column whole = column(first, values);
    for (const auto& ends : {std::array{"_blue", "_green", "_red"}, std::array{"_x", "_y", "_z"}}) {
      if (!first.ends_with(ends[0])) continue;
      const std::string name = first.substr(0, first.size() - std::string_view(ends[0]).size());
      if (!maps.contains(name + ends[1]) || !maps.contains(name + ends[2])) continue;
      std::array parts{&values, &maps.at(name + ends[1]), &maps.at(name + ends[2])};
      if (ends[0] == std::string_view("_blue")) std::swap(parts[0], parts[2]);
      whole = {name, 3, {}};
      for (std::size_t v = 0; v < values.size(); ++v)
        for (const auto* part : parts) whole.values.push_back((*part)[v]);
      done.insert({name + ends[1], name + ends[2]});
    }
    whole.name = nameOfMap(std::move(whole.name), columns);
    if (!values.empty()) columns.push_back(std::move(whole));
  }
  for (const auto& [name, values] : surface.vectors)
    if (!values.empty()) columns.push_back(column(nameOfMap(name, columns), values));
}

std::vector<float> stretches(const texture::TexturedSurface& surface) {
  std::vector<float> result(surface.gradient.size());
  for (std::uint32_t v = 0; v < result.size(); ++v)
    result[v] = texture::stretch(surface.gradient[v], surface.spacingAt(v));
  return result;
}

// All but positions, normals, colours and UV sets.
std::vector<Column> columnsOf(const texture::TexturedSurface& surface, bool lookedUp) {
  std::vector<Column> columns;
  const auto add = [&](const std::string& name, const auto& values) {
    if (!values.empty()) columns.push_back(column(name, values));
  };
  add("velocity", surface.velocity);
  add("orientation", surface.orientation);
  add("previous_position", surface.previousPosition);
  add("trust", surface.trust);
  add("age", surface.age);
  add("contact", surface.contact);
  add("scale", surface.scale);
  add("guidance", surface.guidance);
  add("foam", surface.foam);
  if (lookedUp) {
    add("fade", surface.fading.weight);
    if (surface.spacing > 0.0) add("stretch", stretches(surface));
    const auto addGradient = [&](const std::string& name,
                                 const std::vector<texture::TexelGradient>& gradient) {
      const Shares share(surface);
      std::vector<texture::Vec3f> s, t;
      for (const texture::TexelGradient& g : gradient) {
        s.push_back(g.s / share.width);
        t.push_back(g.t / share.height);
      }
      add(name + "_s", s);
      add(name + "_t", t);
    };
    addGradient("gradient", surface.gradient);
    addGradient("fade_gradient", surface.fading.gradient);
  }
  addMaps(surface, columns);
  return columns;
}

Column uvColumn(const std::string& name, const std::vector<texture::Vec2f>& texels, const Shares& share) {
  std::vector<texture::Vec2f> values(texels.size());
  std::transform(texels.begin(), texels.end(), values.begin(), share);
  return column(name, values);
}

// Three UV sets of what is shown and of what fades, and the weights.
std::vector<Column> blendedSets(const texture::TexturedSurface& surface, bool toroidal) {
  const texture::Joints found = texture::findJoints(surface, toroidal);
  const texture::Torus torus(surface, toroidal);
  const Shares share(surface);
  const std::size_t corners = 3 * surface.triangles.size();
  std::array<std::vector<texture::Vec2f>, 6> sets;
  for (auto& set : sets) set.resize(corners);
  // Where there is no joint the three places are one, and so are all weights.
  std::vector<texture::Vec3f> weights(corners, {1.0f, 0.0f, 0.0f});
  auto joint = found.joints.begin();
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const bool isJoint = joint != found.joints.end() && joint->triangle == t;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t v = surface.triangles[t][int(c)];
      for (std::size_t label = 0; label < 3; ++label) {
        sets[label][3 * t + c] =
            share(isJoint ? joint->shown[label][c] : torus.brought(surface.coordinate[v]));
        sets[3 + label][3 * t + c] =
            share(isJoint ? joint->former[label][c] : torus.brought(found.former.places.coordinate[v]));
      }
      if (isJoint) {
        weights[3 * t + c] = texture::Vec3f(0.0f);
        weights[3 * t + c][int(c)] = 1.0f;
      }
    }
    if (isJoint) ++joint;
  }
  std::vector<Column> columns;
  for (std::size_t i = 0; i < sets.size(); ++i) columns.push_back(column(kUvSets[i], sets[i]));
  columns.push_back(column("joint", weights));
  return columns;
}

ExportMesh withoutSets(const texture::TexturedSurface& surface, bool lookedUp, int frame, double time) {
  return {frame,
          time,
          surface.positions,
          surface.normals,
          surface.triangles,
          surface.color,
          columnsOf(surface, lookedUp),
          {}};
}

}  // namespace

ExportMesh exportMesh(const texture::TexturedSurface& surface, bool lookedUp, bool toroidal, JointsAs joints,
                      int frame, double time) {
  if (!lookedUp || surface.empty()) return withoutSets(surface, false, frame, time);
  if (joints == JointsAs::blend) {
    ExportMesh mesh = withoutSets(surface, true, frame, time);
    mesh.corner = blendedSets(surface, toroidal);
    return mesh;
  }
  const texture::TexturedSurface cut = texture::cutAtJoints(surface, toroidal).surface;
  ExportMesh mesh = withoutSets(cut, true, frame, time);
  const Shares share(cut);
  mesh.vertex.push_back(uvColumn("st", cut.coordinate, share));
  mesh.vertex.push_back(uvColumn("fade_st", cut.fading.coordinate, share));
  return mesh;
}

bool isUvSet(const std::string& name) {
  return std::find(std::begin(kUvSets), std::end(kUvSets), name) != std::end(kUvSets);
}

const Column* findColumn(const std::vector<Column>& columns, const std::string& name) {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

IndexedColumn indexed(const ExportMesh& mesh, const std::vector<const Column*>& columns) {
  IndexedColumn result;
  const std::size_t corners = 3 * mesh.triangles.size();
  result.index.resize(corners);
  // The rows of a vertex are a chain, which is short: few pieces meet at a vertex.
  std::vector<std::uint32_t> head(mesh.positions.size(), kNone), next;
  for (std::uint32_t c = 0; c < corners; ++c) {
    const std::uint32_t vertex = mesh.triangles[c / 3][int(c % 3)];
    std::uint32_t row = head[vertex], last = kNone;
    while (row != kNone && !sameRow(columns, result.first[row], c)) last = std::exchange(row, next[row]);
    if (row == kNone) {
      row = std::uint32_t(result.first.size());
      result.first.push_back(c);
      next.push_back(kNone);
      (last == kNone ? head[vertex] : next[last]) = row;
    }
    result.index[c] = row;
  }
  return result;
}

ExportMesh splitAtCorners(const ExportMesh& mesh) {
  std::vector<const Column*> columns;
  for (const Column& column : mesh.corner) columns.push_back(&column);
  const IndexedColumn rows = indexed(mesh, columns);
  const auto count = std::uint32_t(mesh.positions.size());
  // Of each new vertex: the one that it is a copy of, and a corner with its row.
  std::vector<std::uint32_t> from(count), corner(count, kNone), number(rows.first.size());
  std::iota(from.begin(), from.end(), 0u);
  for (std::uint32_t row = 0; row < rows.first.size(); ++row) {
    const std::uint32_t c = rows.first[row], vertex = mesh.triangles[c / 3][int(c % 3)];
    number[row] = vertex;
    if (corner[vertex] == kNone) {
      corner[vertex] = c;
    } else {
      number[row] = std::uint32_t(from.size());
      from.push_back(vertex);
      corner.push_back(c);
    }
  }
  ExportMesh split;
  split.frame = mesh.frame;
  split.time = mesh.time;
  split.positions = picked(mesh.positions, from);
  split.normals = picked(mesh.normals, from);
  split.color = picked(mesh.color, from);
  split.triangles.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < split.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) split.triangles[t][k] = number[rows.index[3 * t + std::size_t(k)]];
  for (const Column& column : mesh.vertex) split.vertex.push_back(picked(column, from));
  for (const Column& column : mesh.corner) split.vertex.push_back(picked(column, corner));
  return split;
}

}  // namespace fluidtex::tools
