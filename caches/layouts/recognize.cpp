#include "caches/formats/read_geometry.h"
#include "caches/layouts/nothing_here.h"
#include "caches/layouts/programs.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <set>
#include <system_error>
#include <utility>

namespace fluidtex::caches {
namespace fs = std::filesystem;
namespace {

bool isGrids(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return ending == ".vdb";
}

// What `choose` finds in the first file that holds anything: programs leave empty files, and files with
// nothing in them, for frames before the liquid.
template <class Choose, class HoldsAnything>
auto firstChoice(const NumberedFiles& files, fs::path& sample, const Choose& choose,
                 const HoldsAnything& holdsAnything) {
  for (const auto& [number, file] : files.byNumber) {
    if (isEmptyFile(file)) continue;
    sample = file;
    if (auto choice = choose(file); holdsAnything(choice)) return choice;
  }
  if (sample.empty()) sample = files.byNumber.begin()->second;
  return choose(sample);
}

GridChoice gridsOf(const NumberedFiles& files, const Options& options, fs::path& sample) {
  return firstChoice(
      files, sample, [&](const fs::path& file) { return chooseGrids(file, options); },
      [](const GridChoice& choice) {
        return !choice.surface.empty() || !choice.velocity.empty() || !choice.scalars.empty() ||
               !choice.vectors.empty();
      });
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

// Adds the further grids or attributes of a choice, but for names that there are already.
template <class Choice>
void addFields(const Choice& choice, bool withVelocity, Layout& layout) {
  const auto add = [&](const Field& field) {
    const auto known = [&](const Field& other) { return scalarNames(other) == scalarNames(field); };
    if (std::none_of(layout.fields.begin(), layout.fields.end(), known)) layout.fields.push_back(field);
  };
  for (const std::string& name : choice.scalars) add({name, false, withVelocity});
  for (const std::string& name : choice.vectors) add({name, true, withVelocity});
}

void takeGrids(const NumberedFiles& files, const Options& options, Layout& layout) {
  fs::path sample;
  GridChoice choice = gridsOf(files, options, sample);
  if (choice.surface.empty())
    throw LayoutError(
        sample.string() +
        ": holds no grid that can be the surface: none is a level set, or density; name it with "
        "files.surface_name");
  layout.surface = files;
  layout.surfaceKind = choice.fog ? SurfaceKind::fog : SurfaceKind::levelSet;
  layout.surfaceName = choice.surface;
  addFields(choice, false, layout);
  if (choice.velocity.empty()) return;
  layout.velocity = files;
  layout.velocityKind = VelocityKind::grids;
  layout.velocityNames = choice.velocity;
  layout.onFaces = choice.onFaces;
}

void takeGeometry(const NumberedFiles& files, const Options& options, Layout& layout) {
  Options surfaceOnly = options;
  if (!options.velocity.empty()) surfaceOnly.velocityName.clear();
  fs::path sample;
  AttributeChoice choice = firstChoice(
      files, sample, [&](const fs::path& file) { return chooseAttributes(file, surfaceOnly); },
      [](const AttributeChoice& found) { return found.points; });
  layout.surface = files;
  layout.surfaceKind = choice.triangles ? SurfaceKind::mesh : SurfaceKind::particles;
  addFields(choice, false, layout);
  if (choice.velocity.empty()) return;
  layout.velocityKind = VelocityKind::attribute;
  layout.velocityNames = {choice.velocity};
}

// Velocity from OpenVDB files of its own.
void takeVelocity(const NumberedFiles& files, const Options& options, Layout& layout) {
  Options velocityOnly = options;
  velocityOnly.surfaceName.clear();
  fs::path sample;
  const GridChoice choice = gridsOf(files, velocityOnly, sample);
  if (choice.velocity.empty())
    throw LayoutError(sample.string() +
                      ": holds no grid that can be a velocity; name it with files.velocity_name");
  layout.velocity = files;
  layout.velocityKind = VelocityKind::grids;
  layout.velocityNames = choice.velocity;
  layout.onFaces = choice.onFaces;
  addFields(choice, true, layout);
}

Layout fromFolder(const fs::path& folder, const Options& options) {
  std::vector<NumberedFiles> grids, geometry;
  const auto isRead = [](const std::string& name) { return isGrids(name) || isGeometryFile(name); };
  for (NumberedFiles& files : sequencesIn(folder, isRead))
    (isGrids(files.pattern) ? grids : geometry).push_back(std::move(files));
  Layout layout;
  if (!geometry.empty()) {
    takeGeometry(theOne(std::move(geometry), folder, "meshes or particles"), options, layout);
    if (layout.velocityKind == VelocityKind::none && options.velocity.empty() && !grids.empty())
      takeVelocity(theOne(std::move(grids), folder, "OpenVDB files"), options, layout);
    return layout;
  }
  if (grids.empty()) throw LayoutError(nothingHere(folder));
  takeGrids(theOne(std::move(grids), folder, "OpenVDB files"), options, layout);
  return layout;
}

Layout fromFiles(const fs::path& path, const Options& options) {
  Layout layout;
  const NumberedFiles files = numberedLike(path);
  if (isGrids(files.pattern))
    takeGrids(files, options, layout);
  else
    takeGeometry(files, options, layout);  // says what is wrong with any other file
  return layout;
}

// The known cache that a file, or a pattern, is part of: only there its place and unit are known.
std::optional<Layout> cacheOfFile(const fs::path& file, const Options& options) {
  if (!options.velocity.empty()) return std::nullopt;
  const fs::path folder = file.parent_path();
  const std::string name = folder.filename().string();
  if (name == "mesh" || name == "data" || name == "config") return mantaflowCache(folder, options);
  if (name == "bakefiles") return flipFluidsCache(folder);
  return std::nullopt;
}

Layout layoutAt(const Options& options) {
  std::error_code unknown;
  const fs::path path = fs::absolute(options.path).lexically_normal();
  if (!fs::is_directory(path, unknown)) {
    if (std::optional<Layout> layout = cacheOfFile(path, options)) return *layout;
    return fromFiles(options.path, options);
  }
  const fs::path plain = path.filename().empty() ? path.parent_path() : path;
  if (std::optional<Layout> layout = mantaflowCache(plain, options)) return *layout;
  if (std::optional<Layout> layout = flipFluidsCache(plain)) return *layout;
  return fromFolder(plain, options);
}

std::string rangeOf(const NumberedFiles& files) {
  return std::to_string(files.first()) + " to " + std::to_string(files.last());
}

// Frames that have all files.
void findFrames(const Options& options, Layout& layout) {
  const std::array<const NumberedFiles*, 4> sources{&layout.surface, &layout.velocity, &layout.config,
                                                    &layout.blur};
  int first = layout.surface.first(), last = layout.surface.last();
  for (const NumberedFiles* files : sources) {
    if (files->empty()) continue;
    first = std::max(first, files->first());
    last = std::min(last, files->last());
  }
  // Of ranges that have nothing in common, two have not.
  for (const NumberedFiles* a : sources)
    for (const NumberedFiles* b : sources)
      if (!a->empty() && !b->empty() && a->last() < b->first())
        throw LayoutError(a->pattern.string() + " and " + b->pattern.string() +
                          ": have no number in common (" + rangeOf(*a) + ", " + rangeOf(*b) +
                          "); write both for the same frames");
  const bool isThere = std::all_of(sources.begin(), sources.end(), [&](const NumberedFiles* files) {
    return files->empty() || files->byNumber.contains(options.first);
  });
  if (options.first >= 0 && (options.first < first || options.first > last || !isThere))
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

std::string namesOf(const std::vector<Field>& fields) {
  std::vector<std::string> names;
  for (const Field& field : fields)
    for (const std::string& name : scalarNames(field)) names.push_back(name);
  return joined(names);
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

std::vector<std::string> scalarNames(const Field& field) {
  std::string name = field.name;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front()))) name = "_" + name;
  if (!field.vectors) return {name};
  return {name + "_x", name + "_y", name + "_z"};
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
  if (!layout.fields.empty()) lines.push_back("further   " + namesOf(layout.fields));
  return lines;
}

}  // namespace fluidtex::caches
