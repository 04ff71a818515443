#include "scenes/checks.h"
#include "scenes/value_text.h"

namespace fluidtex::scenes {
void checkSequence(const sim::MeshSequence& sequence, const std::string& path, Reader& reader) {
  if (!reader.clean(path)) return;
  if (sequence.last < sequence.first) {
    reader.fault(path + ".last",
                 written(sequence.last) + " is before first, which is " + written(sequence.first),
                 "give the number of the last file");
    return;
  }
  for (int n = 0; n < sequence.count(); ++n) {
    const std::filesystem::path file = sequence.fileOf(n);
    std::error_code error;
    if (std::filesystem::is_regular_file(file, error)) continue;
    reader.fault(path + ".files", "no such file: " + file.string(),
                 "give all from number " + written(sequence.first) + " to " + written(sequence.last));
    return;
  }
}

void checkShape(const sim::Shape& shape, const std::string& path, Reader& reader) {
  const auto checkParts = [&](const std::vector<sim::Shape>& parts, const std::string& key) {
    for (std::size_t i = 0; i < parts.size(); ++i)
      checkShape(parts[i], path + "." + key + "." + std::to_string(i), reader);
  };
  if (const auto* box = std::get_if<sim::Box>(&shape.kind)) {
    if (!reader.clean(path + ".box")) return;
    for (int axis = 0; axis < 3; ++axis) {
      if (box->min[axis] < box->max[axis]) continue;
      reader.fault(path + ".box.max",
                   std::string(kAxes[axis]) + " is " + written(box->max[axis]) + ", not above min's " +
                       written(box->min[axis]),
                   "give a max that is greater than min in x, y and z");
    }
  } else if (const auto* cylinder = std::get_if<sim::Cylinder>(&shape.kind)) {
    if (reader.clean(path + ".cylinder") && cylinder->from == cylinder->to)
      reader.fault(path + ".cylinder.to", "is the same point as from", "give the middle of the other end");
  } else if (const auto* ground = std::get_if<sim::HeightField>(&shape.kind)) {
    if (reader.clean(path + ".height_field") && !(ground->low < ground->high))
      reader.fault(path + ".height_field.high",
                   written(ground->high) + " is not above low's " + written(ground->low),
                   "give the height of white in metres, greater than that of black");
  } else if (std::holds_alternative<sim::MeshSequence>(shape.kind)) {
    reader.fault(path + ".mesh_sequence", "only the whole shape of a [[solid]] can change",
                 "give mesh with one of its files");
  } else if (const auto* space = std::get_if<sim::HalfSpace>(&shape.kind)) {
    if (reader.clean(path + ".half_space") && space->normal.length() == 0.0)
      reader.fault(path + ".half_space.normal", "has no length",
                   "give the direction out of the shape, for example [0, 0, 1]");
  } else if (const auto* both = std::get_if<sim::Union>(&shape.kind)) {
    checkParts(both->parts, "union");
  } else if (const auto* rest = std::get_if<sim::Difference>(&shape.kind)) {
    checkParts(rest->parts, "difference");
    if (reader.clean(path + ".difference") && rest->parts.size() == 1)
      reader.fault(path + ".difference", "has one part only",
                   "give the shape and, after it, what is taken away from it");
  }
}

}  // namespace fluidtex::scenes
