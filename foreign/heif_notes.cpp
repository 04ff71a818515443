#include "foreign/heif_notes.h"

#include <libheif/heif.h>

#include <memory>
#include <vector>

namespace fluidtex::foreign {

void addHeifNotes(const std::filesystem::path& file, OIIO::ImageSpec& spec) {
  const std::unique_ptr<heif_context, void (*)(heif_context*)> context(heif_context_alloc(),
                                                                       heif_context_free);
  if (!context || heif_context_read_from_file(context.get(), file.c_str(), nullptr).code != heif_error_Ok)
    return;
  heif_image_handle* primary = nullptr;
  if (heif_context_get_primary_image_handle(context.get(), &primary).code != heif_error_Ok) return;
  const std::unique_ptr<heif_image_handle, void (*)(const heif_image_handle*)> handle(
      primary, heif_image_handle_release);
  const std::size_t size = heif_image_handle_get_raw_color_profile_size(primary);
  std::vector<unsigned char> profile(size);
  if (size > 0 && heif_image_handle_get_raw_color_profile(primary, profile.data()).code == heif_error_Ok) {
    spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, int(size)), profile.data());
    return;
  }
  heif_color_profile_nclx* codes = nullptr;
  if (heif_image_handle_get_nclx_color_profile(primary, &codes).code != heif_error_Ok || codes == nullptr)
    return;
  const std::unique_ptr<heif_color_profile_nclx, void (*)(heif_color_profile_nclx*)> held(
      codes, heif_nclx_color_profile_free);
  if (codes->color_primaries == heif_color_primaries_unspecified) return;
  const float xy[8] = {codes->color_primary_red_x,   codes->color_primary_red_y,
                       codes->color_primary_green_x, codes->color_primary_green_y,
                       codes->color_primary_blue_x,  codes->color_primary_blue_y,
                       codes->color_primary_white_x, codes->color_primary_white_y};
  spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), xy);
}

}  // namespace fluidtex::foreign
