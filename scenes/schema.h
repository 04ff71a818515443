// Schema of a scene file: every key with its limits and the setting it stands for. Documented in
// scenes/README.md.
#pragma once

#include "scenes/scene.h"
#include "scenes/visitor.h"

namespace fluidtex::scenes {

// Keys of which only one can stand in a table: in the order of sim::Shape's kinds, and points before spacing.
inline const std::vector<std::string> kShapeKeys = {"box",          "sphere", "cylinder",
                                                    "half_space",   "mesh",   "mesh_sequence",
                                                    "height_field", "union",  "difference"};
inline const std::vector<std::string> kDensityKeys = {"points", "spacing"};

// Most points there can be: of texture.points, and by texture.spacing on the domain's six faces.
inline constexpr double kMostPoints = 50e6;

// In the order of sim::DomainFace.
inline const std::vector<std::string> kDomainFaces = {"all",    "x_low", "x_high", "y_low",
                                                      "y_high", "z_low", "z_high"};

// texture: optional where only the liquid is looked at: no exemplar is asked for then.
void describe(Visitor& visitor, Scene& scene, Need texture = Need::required);

// The shape keys of one liquid, solid or part: kShapeKeys.
void describeShape(Visitor& visitor, sim::Shape& shape);
// Visits the keys of where a mesh from a file lies, in the table that is open.
void describePlace(Visitor& visitor, sim::MeshPlace& place);

// The domain [0, size], infinite on unbounded sides.
sim::Box domainOf(const sim::Options& options);

// Whether any of the shape can be inside the domain. Meshes, which are read later, count as inside.
bool reachesDomain(const sim::Shape& shape, const sim::Box& domain);

// Whether the part of the shape inside the domain is bounded. What a difference subtracts bounds nothing.
bool endsInDomain(const sim::Shape& shape, const sim::Box& domain);

}  // namespace fluidtex::scenes
