#include "caches/formats/read_geometry.h"
#include "caches/layouts/programs.h"

#include <algorithm>
#include <limits>
#include <set>
#include <system_error>
#include <utility>

namespace fluidtex::caches {
namespace fs = std::filesystem;
namespace {

bool isGrids(const NumberedFiles& files) {
  return files.pattern.extension() == ".vdb";
}

// The first file that holds anything: programs leave empty ones for frames before the liquid.
const fs::path& sampleOf(const NumberedFiles& files) {
  for (const auto& [number, file] : files.byNumber) {
    std::error_code unknown;
    if (fs::file_size(file, unknown) > 0 && !unknown) return file;
  }
  return files.byNumber.begin()->second;
}

std::string patternsOf(const std::vector<NumberedFiles>& sequences) {
  std::string text;
  for (const NumberedFiles& files : sequences)
    text += (text.empty() ? "" : ", ") + files.pattern.filename().string();
  return text;
}

// The one with most files; an error where two have as many.
NumberedFiles theOne(std::vector<NumberedFiles> candidates, const fs::path& folder, const char* kind) {
  const auto more = [](const NumberedFiles& a, const NumberedFiles& b) {
    return a.byNumber.size() < b.byNumber.size();
  };
  const auto most = std::max_element(candidates.begin(), candidates.end(), more);
  const auto asMany = std::count_if(candidates.begin(), candidates.end(), [&](const NumberedFiles& files) {
    return files.byNumber.size() == most->byNumber.size();
  });
  if (asMany > 1)
    throw LayoutError(folder.string() + ": holds several sequences of " + kind + " (" +
                      patternsOf(candidates) + "); name one of them, as in " + most->pattern.string());
  return std::move(*most);
}

void takeGrids(const NumberedFiles& files, const Options& options, Layout& layout) {
  const fs::path& sample = sampleOf(files);
  GridChoice choice = chooseGrids(sample, options);
  if (choice.surface.empty())
    throw LayoutError(
        sample.string() +
        ": holds no grid that can be the surface: none is a level set, or density; name it with "
        "files.surface_name");
  layout.surface = files;
  layout.surfaceKind = choice.fog ? SurfaceKind::fog : SurfaceKind::levelSet;
  layout.surfaceName = choice.surface;
  layout.scalars = choice.scalars;
  if (choice.velocity.empty()) return;
  layout.velocity = files;
  layout.velocityKind = VelocityKind::grids;
  layout.velocityNames = choice.velocity;
  layout.onFaces = choice.onFaces;
}

void takeGeometry(const NumberedFiles& files, const Options& options, Layout& layout) {
  Options surfaceOnly = options;
  if (!options.velocity.empty()) surfaceOnly.velocityName.clear();
  AttributeChoice choice = chooseAttributes(sampleOf(files), surfaceOnly);
  layout.surface = files;
  layout.surfaceKind = choice.triangles ? SurfaceKind::mesh : SurfaceKind::particles;
  layout.scalars = choice.scalars;
  if (choice.velocity.empty()) return;
  layout.velocityKind = VelocityKind::attribute;
  layout.velocityNames = {choice.velocity};
}

// Velocity from OpenVDB files of its own.
void takeVelocity(const NumberedFiles& files, const Options& options, Layout& layout) {
  Options velocityOnly = options;
  velocityOnly.surfaceName.clear();
  const GridChoice choice = chooseGrids(sampleOf(files), velocityOnly);
  if (choice.velocity.empty())
    throw LayoutError(sampleOf(files).string() +
                      ": holds no grid that can be a velocity; name it with files.velocity_name");
  layout.velocity = files;
  layout.velocityKind = VelocityKind::grids;
  layout.velocityNames = choice.velocity;
  layout.onFaces = choice.onFaces;
}

Layout fromFolder(const fs::path& folder, const Options& options) {
  std::vector<NumberedFiles> grids, geometry;
  for (NumberedFiles& files : sequencesIn(folder)) {
    if (isGrids(files))
      grids.push_back(std::move(files));
    else if (isGeometryFile(files.pattern))
      geometry.push_back(std::move(files));
  }
  Layout layout;
  if (!geometry.empty()) {
    takeGeometry(theOne(std::move(geometry), folder, "meshes or particles"), options, layout);
    if (layout.velocityKind == VelocityKind::none && options.velocity.empty() && !grids.empty())
      takeVelocity(theOne(std::move(grids), folder, "OpenVDB files"), options, layout);
    return layout;
  }
  if (grids.empty())
    throw LayoutError(
        folder.string() +
        ": holds nothing that can be read as a liquid; give Blender's or FLIP Fluids' cache folder, or "
        "a folder of numbered files: .vdb, .ply, .obj, .stl, .vtp, .vtk, .bobj, .bgeo");
  takeGrids(theOne(std::move(grids), folder, "OpenVDB files"), options, layout);
  return layout;
}

Layout fromFiles(const fs::path& path, const Options& options) {
  Layout layout;
  const NumberedFiles files = numberedLike(path);
  if (isGrids(files))
    takeGrids(files, options, layout);
  else
    takeGeometry(files, options, layout);  // says what is wrong with any other file
  return layout;
}

Layout layoutAt(const Options& options) {
  std::error_code unknown;
  if (!fs::is_directory(options.path, unknown)) return fromFiles(options.path, options);
  const fs::path folder = fs::absolute(options.path).lexically_normal();
  const fs::path plain = folder.filename().empty() ? folder.parent_path() : folder;
  if (std::optional<Layout> layout = mantaflowCache(plain, options)) return *layout;
  if (std::optional<Layout> layout = flipFluidsCache(plain)) return *layout;
  return fromFolder(plain, options);
}

// Frames that have all files.
void findFrames(const Options& options, Layout& layout) {
  int first = layout.surface.first(), last = layout.surface.last();
  for (const NumberedFiles* files : {&layout.velocity, &layout.config}) {
    if (files->empty()) continue;
    first = std::max(first, files->first());
    last = std::min(last, files->last());
  }
  if (first > last)
    throw LayoutError(layout.surface.pattern.string() + " and " + layout.velocity.pattern.string() +
                      ": have no number in common (" + std::to_string(layout.surface.first()) + " to " +
                      std::to_string(layout.surface.last()) + ", " + std::to_string(layout.velocity.first()) +
                      " to " + std::to_string(layout.velocity.last()) + "); write both for the same frames");
  if (options.first >= 0 && (options.first < first || options.first > last))
    throw LayoutError("files.first: there is no frame " + std::to_string(options.first) + "; there are " +
                      std::to_string(first) + " to " + std::to_string(last));
  layout.first = options.first >= 0 ? options.first : first;
  layout.last = last;
}

std::string rangeOf(const Layout& layout) {
  return std::to_string(layout.first) + " to " + std::to_string(layout.last);
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

const char* nameOf(SurfaceKind kind) {
  switch (kind) {
    case SurfaceKind::mesh:
      return "meshes";
    case SurfaceKind::levelSet:
      return "level sets";
    case SurfaceKind::fog:
      return "densities";
    case SurfaceKind::mantaflow:
      return "mantaflow's distances in voxels";
    case SurfaceKind::particles:
      return "particles";
  }
  return "";
}

std::string velocityText(const Layout& layout) {
  switch (layout.velocityKind) {
    case VelocityKind::none:
      return "none: the files hold none that is known";
    case VelocityKind::attribute:
      return "attribute " + layout.velocityNames.front() + " of these";
    case VelocityKind::flipFluids:
      return layout.velocity.pattern.filename().string() +
             (layout.blur.empty() ? ", by files.velocity_scale" : ", its unit from blur####.bobj");
    case VelocityKind::grids:
      return layout.velocity.pattern.filename().string() + ", grid" +
             (layout.velocityNames.size() > 1 ? "s " : " ") + joined(layout.velocityNames) +
             (layout.onFaces ? ", at faces" : "");
  }
  return "";
}

}  // namespace

Layout recognize(const Options& options) {
  Layout layout = layoutAt(options);
  if (!options.velocity.empty()) takeVelocity(numberedLike(options.velocity), options, layout);
  findFrames(options, layout);
  return layout;
}

std::vector<std::string> describe(const Layout& layout) {
  const char* program = layout.program == Program::mantaflow    ? "Blender's liquid (mantaflow)"
                        : layout.program == Program::flipFluids ? "FLIP Fluids"
                                                                : "files of one a frame";
  std::vector<std::string> lines{std::string("cache     ") + program + ", frames " + rangeOf(layout),
                                 "surface   " + layout.surface.pattern.filename().string() + ", " +
                                     nameOf(layout.surfaceKind) +
                                     (layout.surfaceName.empty() ? "" : ", grid " + layout.surfaceName),
                                 "velocity  " + velocityText(layout)};
  if (!layout.scalars.empty()) lines.push_back("further   " + joined(layout.scalars));
  return lines;
}

}  // namespace fluidtex::caches
