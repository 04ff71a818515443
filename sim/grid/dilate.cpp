#include "sim/grid/dilate.h"

FLUIDTEX_DILATE(, fluidtex::sim::FloatTree)
FLUIDTEX_DILATE(, fluidtex::sim::MaskTree)
