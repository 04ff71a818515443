#include "scenes/schema.h"

namespace fluidtex::scenes {

namespace {

// Of what ends at a time, or never.
constexpr Limits kUntil{.low = 0.0, .aboveLow = true, .infinite = true};
void describeWall(Visitor& visitor, sim::Wall& wall) {
  choice(visitor, "wall", wall.kind, {"slip", "no_slip", "friction"});
  visitor.number("slip_length", wall.slipLength, kPositive);
  visitor.vector("wall_velocity", wall.velocity, kAny);
}

void describeMotion(Visitor& visitor, sim::MotionOptions& motion) {
  visitor.table("motion", [&] {
    choice(
        visitor, "flow", motion.flow,
        {"solver", "rest", "rotation", "vortex", "deformation", "stretch", "source_sink", "slot", "files"});
    visitor.number("period", motion.period, kPositive);
    visitor.number("rate", motion.rate, kPositive);
    visitor.number("speed", motion.speed, kPositive);
    visitor.number("strain", motion.strain, kNotNegative);
    visitor.number("widening", motion.widening, kNotNegative);
  });
}

void describeFiles(Visitor& visitor, Scene& scene) {
  caches::Options& files = scene.files;
  visitor.table("files", [&] {
    visitor.path("path", files.path);
    visitor.path("velocity", files.velocity);
    visitor.text("surface_name", files.surfaceName);
    visitor.text("velocity_name", files.velocityName);
    visitor.integer("first", files.first, {.low = -1, .high = 1e9});
    visitor.number("unit", files.unit, kPositive);
    choice(visitor, "up", files.up, {"z", "y"});
    visitor.vector("turn", files.turn, {.low = -360.0, .high = 360.0});
    visitor.number("scale", files.scale, kPositive);
    visitor.vector("move", files.move, kAny);
    visitor.number("iso", files.iso, kAny);
    visitor.number("velocity_scale", files.velocityScale, kAny);
    visitor.number("radius", files.radius, kNotNegative);
    visitor.number("voxel", files.voxel, kNotNegative);
    visitor.number("least_piece", files.leastPiece, kNotNegative);
    visitor.number("least_explained", files.leastExplained, kShare);
    visitor.flag("fit", files.fit);
    visitor.flag("onto", scene.ontoSource);
  });
}

// The domain of a liquid out of files is found, where nothing is said of it.
void describeLiquid(Visitor& visitor, sim::Options& sim, bool solved) {
  const Need need = solved ? Need::required : Need::optional;
  visitor.table(
      "domain",
      [&] {
        visitor.vector("size", sim.size, kPositive, need);
        visitor.integer("resolution", sim.resolution, {.low = 8, .high = 4096});
        visitor.table("sides", [&] {
          static const char* const kKeys[] = {"x_low", "x_high", "y_low", "y_high", "z_low", "z_high"};
          for (std::size_t n = 0; n < sim.sides.size(); ++n)
            choice(visitor, kKeys[n], sim.sides[n], {"wall", "open", "stream", "symmetry", "unbounded"});
        });
      },
      need);
  visitor.table("fluid", [&] {
    visitor.number("density", sim.density, kPositive);
    visitor.number("viscosity", sim.viscosity, kNotNegative);
    visitor.number("surface_tension", sim.surfaceTension, kNotNegative);
    visitor.vector("gravity", sim.gravity, kAny);
  });
  visitor.table("heat", [&] {
    sim::HeatOptions& heat = sim.heat;
    visitor.flag("simulate", heat.simulated);
    visitor.number("capacity", heat.capacity, kPositive);
    visitor.number("conductivity", heat.conductivity, kNotNegative);
    visitor.number("emissivity", heat.emissivity, kShare);
    visitor.number("ambient", heat.ambient, kNotNegative);
    visitor.number("wall_transfer", heat.wallTransfer, kNotNegative);
    visitor.number("wall_temperature", heat.wallTemperature, kNotNegative);
    choice(visitor, "law", heat.law.kind, {"constant", "exponential", "arrhenius", "table"});
    visitor.number("reference", heat.law.reference, kPositive);
    visitor.number("slope", heat.law.slope, kNotNegative);
    visitor.number("activation_energy", heat.law.activationEnergy, kNotNegative);
    visitor.number("solidus", heat.law.solidus, kNotNegative);
    visitor.number("solid_viscosity", heat.law.solidViscosity, kPositive);
    visitor.list("point", heat.law.points, [&](sim::ViscosityPoint& point) {
      visitor.number("temperature", point.temperature, kPositive, Need::required);
      visitor.number("viscosity", point.viscosity, kPositive, Need::required);
    });
  });
  visitor.table("simulation", [&] { visitor.number("cfl", sim.cfl, {.low = 0.1, .high = 4.0}); });
  visitor.list("wall", sim.walls, [&](sim::DomainWall& wall) {
    choice(visitor, "face", wall.face, kDomainFaces);
    describeWall(visitor, wall.wall);
  });
  visitor.list("liquid", sim.liquid, [&](sim::LiquidBody& body) {
    describeShape(visitor, body.shape);
    visitor.vector("velocity", body.velocity, kAny);
    visitor.number("from", body.from, kNotNegative);
    visitor.number("temperature", body.temperature, kPositive);
    visitor.number("mixture", body.mixture, kShare);
  });
  visitor.list("solid", sim.solids, [&](sim::Solid& solid) {
    visitor.text("name", solid.name);
    describeShape(visitor, solid.shape);
    visitor.number("from", solid.from, kNotNegative);
    visitor.number("until", solid.until, kUntil);
    describeWall(visitor, solid.wall);
    visitor.flag("visible", solid.visible);
    visitor.vector("color", solid.color, kShare);
    visitor.vector("pivot", solid.pivot, kAny);
    visitor.vector("axis", solid.axis, kAny);
    visitor.list("keyframe", solid.keyframes, [&](sim::Keyframe& key) {
      visitor.number("time", key.time, kNotNegative, Need::required);
      visitor.vector("move", key.move, kAny);
      visitor.number("turn", key.turn, kAny);
    });
  });
  visitor.list("source", sim.sources, [&](sim::Source& source) {
    describeShape(visitor, source.shape);
    visitor.vector("velocity", source.velocity, kAny);
    visitor.number("temperature", source.temperature, kPositive);
    visitor.number("mixture", source.mixture, kShare);
    visitor.number("from", source.from, kNotNegative);
    visitor.number("until", source.until, kUntil);
    visitor.list("rate", source.rate, [&](sim::RatePoint& point) {
      visitor.number("time", point.time, kNotNegative, Need::required);
      visitor.number("factor", point.factor, kNotNegative, Need::required);
    });
  });
  visitor.list("drain", sim.drains, [&](sim::Drain& drain) {
    describeShape(visitor, drain.shape);
    visitor.number("from", drain.from, kNotNegative);
    visitor.number("until", drain.until, kUntil);
  });
}

// The name of a scalar, or of vectors, that the liquid has of its own.
void describeAttribute(Visitor& visitor, bool used, std::string& attribute) {
  if (used)
    visitor.text("attribute", attribute);
  else
    visitor.absent("attribute");
}

void describeOrientation(Visitor& visitor, Scene& scene) {
  texture::OrientationOptions& orientation = scene.texture.orientation;
  visitor.integer("symmetry", orientation.symmetry, {.low = 1, .high = 4});
  visitor.flag("mirrored", orientation.mirrored);
  choice(visitor, "align", orientation.align,
         {"none", "gravity", "flow", "curvature", "direction", "field", "attribute"});
  visitor.number("weight", orientation.weight, kShare);
  visitor.number("angle", orientation.angle, {.low = -360.0, .high = 360.0});
  visitor.vector("direction", orientation.direction, kAny);
  if (orientation.align == texture::Align::field)
    visitor.file("field", orientation.field, {".vdb"});
  else
    visitor.absent("field");
  describeAttribute(visitor, orientation.align == texture::Align::attribute, orientation.attribute);
  visitor.list("keep_clear", scene.keepClear, [&](sim::Shape& shape) { describeShape(visitor, shape); });
}

// from: the shapes that distances are measured from.
void describeFactor(Visitor& visitor, texture::FactorOptions& factor, const Limits& limits,
                    std::vector<sim::Shape>& from) {
  choice(visitor, "by", factor.by, {"none", "distance", "temperature", "height", "field", "attribute"});
  visitor.list("point", factor.points, [&](texture::CurvePoint& point) {
    visitor.number("value", point.value, kAny, Need::required);
    visitor.number("factor", point.result, limits, Need::required);
  });
  if (factor.by == texture::FactorBy::field)
    visitor.file("field", factor.field, {".vdb"});
  else
    visitor.absent("field");
  describeAttribute(visitor, factor.by == texture::FactorBy::attribute, factor.attribute);
  visitor.list("from", from, [&](sim::Shape& shape) { describeShape(visitor, shape); });
}

void describeGuidance(Visitor& visitor, texture::Options& texture) {
  texture::GuidanceOptions& guidance = texture.guidance;
  choice(visitor, "by", guidance.by,
         {"none", "height", "temperature", "mixture", "speed", "vorticity", "curvature", "age", "renewal",
          "foam", "field", "attribute"});
  // Where it chooses pictures of a sequence it chooses no places in them.
  const texture::AnimationOptions& animation = texture.exemplar.animation;
  const bool ofPictures = !animation.pattern.empty() && animation.by == texture::ShowBy::guidance;
  if (guidance.by != texture::GuidanceBy::none && !ofPictures)
    visitor.file("map", texture.exemplar.guidance, {});
  else
    visitor.absent("map");
  visitor.number("weight", texture.synthesis.guidanceWeight, kPositive);
  visitor.list("point", guidance.points, [&](texture::CurvePoint& point) {
    visitor.number("value", point.value, kAny, Need::required);
    visitor.number("level", point.result, kShare, Need::required);
  });
  if (guidance.by == texture::GuidanceBy::field)
    visitor.file("field", guidance.field, {".vdb"});
  else
    visitor.absent("field");
  describeAttribute(visitor, guidance.by == texture::GuidanceBy::attribute, guidance.attribute);
  visitor.table("foam", [&] {
    visitor.number("from", guidance.foam.from, kNotNegative);
    visitor.number("full", guidance.foam.full, kPositive);
    visitor.number("lifetime", guidance.foam.lifetime, kPositive);
  });
}

void describeTexture(Visitor& visitor, Scene& scene, Need need) {
  texture::Options& texture = scene.texture;
  visitor.table(
      "texture",
      [&] {
        if (need == Need::required)
          visitor.picture("exemplar", texture.exemplar.file, texture.exemplar.animation);
        else
          visitor.absent("exemplar");
        visitor.flag("toroidal", texture.exemplar.toroidal);
        choice(visitor, "between", texture.exemplar.between, {"points", "exemplar", "file"});
        if (texture.exemplar.between == texture::Between::file)
          visitor.file("between_file", texture.exemplar.betweenFile, {});
        else
          visitor.absent("between_file");
        const bool spacingGiven =
            visitor.alternative(texture.spacing > 0.0, kDensityKeys, Need::optional) == 1;
        if (spacingGiven) {
          visitor.absent("points");
          visitor.number("spacing", texture.spacing, kPositive);
        } else {
          visitor.integer("points", texture.points, {.low = 100, .high = kMostPoints});
          visitor.absent("spacing");
        }
        texture::SynthesisOptions& synthesis = texture.synthesis;
        choice(visitor, "method", synthesis.method, {"coordinates", "kwatra07", "none"});
        choice(visitor, "later_frames", texture.laterFrames,
               {"synthesize", "advect", "alone", "birth", "dual_rest"});
        visitor.integer("rest_frames", texture.restFrames, {.low = 1, .high = 9999});
        visitor.integers("windows", synthesis.windows, {.low = 3, .high = 255});
        visitor.integers("first_iterations", synthesis.firstIterations, {.low = 1, .high = 1000});
        visitor.integers("later_iterations", synthesis.laterIterations, {.low = 0, .high = 1000});
        visitor.number("robust_exponent", synthesis.robustExponent,
                       {.low = 0.0, .high = 2.0, .aboveLow = true});
        visitor.number("soft_constraint", synthesis.softConstraint, kNotNegative);
        visitor.number("histogram", synthesis.histogram, kNotNegative);
        visitor.number("usage", synthesis.usage, kNotNegative);
        visitor.number("core", synthesis.core, kShare);
        visitor.number("feature", synthesis.featureWeight, kNotNegative);
        visitor.number("gradient", synthesis.gradientWeight, kNotNegative);
        visitor.number("coherence", texture.coherence, kShare);
        visitor.number("keep_stretch", synthesis.keepStretch, {.low = 1.0});
        visitor.number("renewal_radius", synthesis.renewalRadius, {.low = 4.0, .high = 1000.0});
        visitor.number("renewal_rate", synthesis.renewalRate, kNotNegative);
        visitor.number("look_ahead", synthesis.lookAhead, kNotNegative);
        visitor.number("fade", synthesis.fade, kNotNegative);
        visitor.table("surface", [&] {
          choice(visitor, "points", texture.surface.points, {"seeds", "random"});
          visitor.integer("levels", texture.surface.levels, {.low = 1, .high = 8});
          visitor.integer("repulsion_sweeps", texture.surface.repulsionSweeps, {.low = 0, .high = 1000});
        });
        visitor.table("scale", [&] {
          describeFactor(visitor, texture.scale,
                         {.low = texture::kLeastScale, .high = texture::kLargestScale}, scene.scaleFrom);
        });
        visitor.table("renewal", [&] {
          describeFactor(visitor, texture.renewal, {.low = 0.0, .high = texture::kMostWear},
                         scene.renewalFrom);
        });
        visitor.table("start", [&] {
          visitor.file("file", scene.start.mesh.file, {".obj"});
          describePlace(visitor, scene.start.mesh.place);
          visitor.flag("renew", scene.start.renew);
        });
        visitor.table("animation", [&] {
          visitor.number("rate", texture.exemplar.animation.rate, kPositive);
          visitor.flag("loop", texture.exemplar.animation.loop);
          choice(visitor, "by", texture.exemplar.animation.by, {"time", "guidance"});
        });
        visitor.table("guidance", [&] { describeGuidance(visitor, texture); });
        visitor.list("map", texture.exemplar.maps, [&](texture::MapOptions& map) {
          visitor.text("name", map.name);
          visitor.file("file", map.file, {});
          choice(visitor, "holds", map.holds, {"values", "normals", "directions"});
          visitor.number("weight", map.weight, {.low = 0.0, .high = 100.0});
        });
        visitor.table("orientation", [&] { describeOrientation(visitor, scene); });
        visitor.table("transport", [&] {
          choice(visitor, "method", scene.transport.method, {"trace", "grid"});
          choice(visitor, "orientation", scene.transport.orientation, {"vector", "scalars"});
        });
        visitor.table("onto", [&] {
          visitor.files("files", scene.onto.files, {".obj", ".ply", ".stl"});
          visitor.integer("first", scene.onto.first, {.low = 0, .high = 1e9});
          describePlace(visitor, scene.onto.place);
        });
      },
      need);
}

void describePicture(Visitor& visitor, render::Options& render) {
  visitor.table("camera", [&] {
    visitor.vector("from", render.camera.from, kAny);
    visitor.vector("at", render.camera.at, kAny);
    visitor.number("fov", render.camera.fov, {.low = 1.0, .high = 170.0});
    visitor.number("turn", render.camera.turn, kAny);
    visitor.number("aperture", render.camera.aperture, kNotNegative);
    visitor.number("focus", render.camera.focus, kNotNegative);
    visitor.number("shutter", render.camera.shutter, {.low = 0.0, .high = 10.0});
  });
  visitor.table("light", [&] {
    visitor.vector("sun_direction", render.light.sunDirection, kAny);
    visitor.vector("sun_color", render.light.sunColor, kNotNegative);
    visitor.number("sun_size", render.light.sunSize, {.low = 0.0, .high = 90.0});
    visitor.vector("sky_color", render.light.skyColor, kNotNegative);
    visitor.vector("horizon_color", render.light.horizonColor, kNotNegative);
  });
  visitor.table("render", [&] {
    visitor.pixels("size", render.width, render.height, {.low = 16, .high = 16384});
    visitor.integer("samples", render.samples, {.low = 1, .high = 65536});
    visitor.number("noise", render.noise, kShare);
    visitor.flag("smooth", render.smooth);
    visitor.integer("bounces", render.bounces, {.low = 0, .high = 64});
    visitor.number("gloss", render.gloss, kShare);
    visitor.number("roughness", render.roughness, kShare);
    visitor.table("material", [&] {
      choice(visitor, "kind", render.material.kind, {"coated", "water", "lava"});
      visitor.number("index", render.material.index, {.low = 1.0, .high = 3.0});
      visitor.vector("absorption", render.material.absorption, kNotNegative);
      visitor.number("cover", render.material.cover, kShare);
      visitor.text("heat", render.material.heat);
      visitor.number("coldest", render.material.coldest, {.low = 300.0, .high = 1e4});
      visitor.number("hottest", render.material.hottest, {.low = 300.0, .high = 1e4});
      visitor.number("glow", render.material.glow, kNotNegative);
    });
    const auto relief = [&](const char* key, render::Bump& relief) {
      visitor.table(key, [&] {
        visitor.text("map", relief.map);
        visitor.number("height", relief.height, kAny);
      });
    };
    relief("displacement", render.displacement);
    relief("bump", render.bump);
    visitor.number("exposure", render.exposure, kPositive);
    visitor.flag("ground", render.surroundings.ground);
    visitor.vector("ground_color", render.surroundings.groundColor, kShare);
    visitor.flag("tank", render.surroundings.tank);
    visitor.vector("tank_color", render.surroundings.tankColor, kShare);
  });
}

}  // namespace

void describe(Visitor& visitor, Scene& scene, Need texture) {
  visitor.text("name", scene.name);
  visitor.integer("frames", scene.frames, {.low = 1, .high = 9999});
  visitor.number("frame_rate", scene.sim.frameRate, {.low = 1.0, .high = 1000.0});
  visitor.seed("seed", scene.seed);
  describeMotion(visitor, scene.motion);
  describeFiles(visitor, scene);
  describeLiquid(visitor, scene.sim, scene.motion.flow != sim::MotionKind::files);
  describeTexture(visitor, scene, texture);
  describePicture(visitor, scene.render);
}

}  // namespace fluidtex::scenes
