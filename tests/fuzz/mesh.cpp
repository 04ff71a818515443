// A mesh, up to the triangles of a solid: the first byte says of which kind the rest is, o(bj), p(ly) or
// s(tl); u: an OBJ with its texture coordinates, up to the triangles in the picture.
#include "sim/meshes/read_uv_mesh.h"
#include "sim/shapes/shape_distance.h"
#include "tests/fuzz/reader.h"

using namespace fluidtex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  const std::string name = data[0] == 'p' ? "mesh.ply" : data[0] == 's' ? "mesh.stl" : "mesh.obj";
  const auto file = fuzz::written(name, data + 1, size - 1);
  return fuzz::outcomeOf<sim::MeshError>([&] {
    if (data[0] == 'u')
      sim::readUvMesh({file});
    else
      sim::readMesh({file});
  });
}
