#include "tools/formats/obj.h"

#include "render/frame_name.h"
#include "texture/exemplar/srgb.h"
#include "tools/formats/text_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::tools {

std::string objMaterials(const Appearance& appearance, int frame) {
  return appearance.moves ? render::frameName(frame) + ".mtl" : kObjMaterials;
}

void writeObj(const ExportMesh& mesh, const Appearance& appearance, std::ostream& out) {
  TextStream text(out);
  text.put("# fluidtex, metres, Y up, frame {}, {:g} s\nmtllib {}\no surface\n", mesh.frame, mesh.time,
           objMaterials(appearance, mesh.frame));
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const texture::Vec3f& x = mesh.positions[v];
    text.put("v {} {} {}", x[0], x[2], -x[1]);
    for (int k = 0; k < 3; ++k)
      text.put(" {:.4g}", std::clamp(texture::encodeSrgb(mesh.color[v][k]), 0.0f, 1.0f));
    text.add("\n");
  }
  for (const texture::Vec3f& n : mesh.normals) text.put("vn {:.5g} {:.5g} {:.5g}\n", n[0], n[2], -n[1]);
  const Column* st = findColumn(mesh.vertex, "st");
  for (std::size_t v = 0; st != nullptr && v < mesh.positions.size(); ++v)
    text.put("vt {} {}\n", st->values[2 * v], 1.0f - st->values[2 * v + 1]);  // origin lower left
  text.put("usemtl exemplar\ns 1\n");
  for (const texture::Vec3I& t : mesh.triangles) {
    if (st != nullptr)
      text.put("f {0}/{0}/{0} {1}/{1}/{1} {2}/{2}/{2}\n", t[0] + 1, t[1] + 1, t[2] + 1);
    else
      text.put("f {0}//{0} {1}//{1} {2}//{2}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  }
}

std::string mtlOf(const Appearance& appearance) {
  // Blinn's exponent of a GGX lobe of that alpha.
  const double alpha = std::max(appearance.roughness, 0.01), exponent = 2.0 / (alpha * alpha) - 2.0;
  // Of a coat with an index of refraction of 1.5, seen head on.
  const double reflected = 0.04 * appearance.gloss;
  std::string text = fmt::format(
      "# fluidtex\nnewmtl exemplar\nKd 1 1 1\nKs {0:.4g} {0:.4g} {0:.4g}\nNs {1:.4g}\nNi 1.5\nillum 2\n",
      reflected, std::min(exponent, 1000.0));
  if (appearance.picture.empty()) return text;
  const std::string options = appearance.toroidal ? "" : "-clamp on ";
  text += fmt::format("map_Kd {}../{}\n", options, appearance.picture);
  if (appearance.seeThrough) text += fmt::format("map_d {}../{}\n", options, appearance.picture);
  return text;
}

}  // namespace fluidtex::tools
