// Scales lie like roof tiles: each is a rounded tongue that hangs down over the two rows below it. For a
// point of the image the scale of the uppermost row that reaches it is seen; its shade comes from a domed
// height and the light, its shadow from the edge of the scales above.
#include "scenes/exemplars/scales.h"

#include "scenes/exemplars/pattern.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::exemplars {

namespace {

// Outline of a scale in units of the distance between columns and between rows.
constexpr double kHalfWidth = 0.535;  // more than 0.5: neighbours meet in a crease
constexpr double kLength = 1.62;      // from the widest place to the free end
constexpr double kRoundness = 2.3;    // exponent of the outline: 2 is an ellipse, more is blunter

struct Scale {
  double x, y;           // of the widest place, image = unit square
  double width, length;  // half width and length of the free end, same units
  double turn;           // how far the free end leans to the side, a share of its length
  double hue, shade;     // -1..1
};

// Where a point lies on a scale.
struct Place {
  double across, along;  // -1..1 across; 0 at the widest place, 1 at the free end
  double rim;            // 0 in the middle, 1 at the outline, more outside
};

// Above the widest place the scale goes straight on.
Place placeOn(const Scale& scale, double x, double y) {
  const double along = (y - scale.y) / scale.length;
  const double across = (x - scale.x - scale.turn * (y - scale.y)) / scale.width;
  const double down = std::max(along, 0.0);
  const double sum = std::pow(std::abs(across), kRoundness) + std::pow(down, kRoundness);
  return {across, along, std::pow(sum, 1.0 / kRoundness)};
}

struct Hit {
  Scale scale;
  double gap;  // to the outline of the nearest scale that lies above, in half widths
};

class Hide {
 public:
  explicit Hide(const Scales& options) : m_options(options) {
    for (int row = 0; row < options.rows; ++row) {
      for (int column = 0; column < options.columns; ++column) m_scales.push_back(makeScale(row, column));
    }
  }

  Color colorAt(double x, double y) const {
    const Hit hit = find(x, y);
    // Differences on one scale: its outline is no slope.
    const double e = 0.25 / m_options.size;
    const double slopeX = (height(hit.scale, x + e, y) - height(hit.scale, x - e, y)) / (2.0 * e);
    const double slopeY = (height(hit.scale, x, y + e) - height(hit.scale, x, y - e)) / (2.0 * e);
    return shaded(hit, slopeX, slopeY, x, y);
  }

  // 0..1. Where a scale goes under those above it lies as deep as their edges need it to.
  double levelAt(double x, double y) const {
    const Hit hit = find(x, y);
    const Place place = placeOn(hit.scale, x, y);
    const double dome = 1.0 - std::pow(std::min(place.rim, 1.0), 2.4);
    const double raised = dome + 0.4 * std::clamp(place.along, 0.0, 1.0) * smooth(1.0, 0.9, place.rim);
    return std::clamp(raised * (1.0 - std::exp(-hit.gap / 0.22)), 0.0, 1.0);
  }

 private:
  Scale makeScale(int row, int column) const {
    const auto vary = [&](std::uint64_t what) {
      return 2.0 * random(m_options.seed, what, std::uint64_t(row), std::uint64_t(column)) - 1.0;
    };
    const double pitchX = 1.0 / m_options.columns, pitchY = 1.0 / m_options.rows;
    return {.x = (column + 0.5 * (row % 2) + 0.07 * vary(1)) * pitchX,
            .y = (row + 0.10 * vary(2)) * pitchY,
            .width = kHalfWidth * pitchX * (1.0 + 0.05 * vary(3)),
            .length = kLength * pitchY * (1.0 + 0.08 * vary(4)),
            .turn = 0.10 * vary(5),
            .hue = vary(6),
            .shade = vary(7)};
  }

  // Rows and columns count on beyond the image's edges.
  Scale scaleAt(int row, int column) const {
    const int r = wrapped(row, m_options.rows), c = wrapped(column, m_options.columns);
    Scale scale = m_scales[std::size_t(r * m_options.columns + c)];
    scale.x += double(column - c) / m_options.columns;
    scale.y += double(row - r) / m_options.rows;
    return scale;
  }

  Hit find(double x, double y) const {
    Hit hit{{}, 1e9};
    const int lowest = int(std::floor(y * m_options.rows)) + 1;
    for (int row = lowest - 4; row <= lowest; ++row) {  // from the uppermost that can reach down to here
      const double shift = 0.5 * wrapped(row, 2);
      const int middle = int(std::floor(x * m_options.columns - shift + 0.5));
      double nearest = 1e9;
      for (int column = middle - 1; column <= middle + 1; ++column) {
        const Scale scale = scaleAt(row, column);
        const double rim = placeOn(scale, x, y).rim;
        if (rim >= nearest) continue;  // where two of a row meet, the nearer one is higher
        nearest = rim;
        hit.scale = scale;
      }
      if (nearest < 1.0) return hit;
      hit.gap = std::min(hit.gap, nearest - 1.0);
    }
    return hit;  // in a chink between scales: on the lowest of them
  }

  // Of the surface: domed across, lifted towards the free end, with a keel and fine grain.
  double height(const Scale& scale, double x, double y) const {
    const Place place = placeOn(scale, x, y);
    const double dome = 0.55 * (1.0 - std::pow(place.rim, 2.4));
    const double lift = 0.14 * place.along;
    const double keel = 0.05 * std::exp(-place.across * place.across / 0.03) * smooth(-0.4, 0.3, place.along);
    const double grain =
        0.035 * noise(m_options.seed, 20, x, y, 128) + 0.05 * noise(m_options.seed, 21, x, y, 71);
    return (dome + lift + keel + grain) * kHalfWidth / m_options.columns;
  }

  Color shaded(const Hit& hit, double slopeX, double slopeY, double x, double y) const {
    const Place place = placeOn(hit.scale, x, y);

    // Broad patches of skin, then each scale's own tone, then from its root to its rim.
    const double patch = 0.6 * noise(m_options.seed, 10, x, y, 3) + 0.4 * noise(m_options.seed, 11, x, y, 7);
    const Color deep{0.020, 0.085, 0.016}, leaf{0.105, 0.315, 0.036}, lime{0.360, 0.560, 0.085};
    const double tone = std::clamp(0.54 + 0.45 * (patch - 0.5) + 0.20 * hit.scale.hue, 0.0, 1.0);
    Color color = tone < 0.5 ? mixed(deep, leaf, 2.0 * tone) : mixed(leaf, lime, 2.0 * tone - 1.0);
    const double body = smooth(1.0, 0.35, place.rim);
    color = mixed(mixed(color, deep, 0.55), color, body);
    color = mixed(color, lime, 0.38 * smooth(0.30, 0.75, place.along) * body);
    // A pale, worn edge just inside the outline of the free end.
    const double edge =
        smooth(0.70, 0.82, place.rim) * smooth(0.96, 0.86, place.rim) * smooth(0.0, 0.5, place.along);
    color = mixed(color, {0.40, 0.56, 0.15}, 0.40 * edge);

    // Light from the upper left; image rows run downwards.
    const double length = std::sqrt(slopeX * slopeX + slopeY * slopeY + 1.0);
    const Color normal{-slopeX / length, -slopeY / length, 1.0 / length};
    const Color light{-0.42, -0.52, 0.744}, half{-0.225, -0.279, 0.934};
    const double facing = std::max(0.0, normal[0] * light[0] + normal[1] * light[1] + normal[2] * light[2]);
    const double shine = std::max(0.0, normal[0] * half[0] + normal[1] * half[1] + normal[2] * half[2]);

    // The scales above keep light away near their edge; at the outline itself there is a dark gap.
    const double open = 1.0 - 0.93 * std::exp(-hit.gap / 0.30);
    const double crease = 1.0 - 0.86 * smooth(0.82, 1.0, place.rim);
    const double speckle = 0.91 + 0.18 * noise(m_options.seed, 30, x, y, m_options.size);
    const double brightness =
        (0.28 + 1.42 * facing) * open * crease * speckle * (1.0 + 0.24 * hit.scale.shade);
    const double gloss = 0.20 * std::pow(shine, 24.0) * open * crease;
    return {color[0] * brightness + gloss * 0.9, color[1] * brightness + gloss,
            color[2] * brightness + gloss * 0.7};
  }

  Scales m_options;
  std::vector<Scale> m_scales;  // rows x columns
};

}  // namespace

std::vector<std::uint8_t> makeGreenScales(const Scales& options) {
  const Hide hide(options);
  return rendered(options.size, options.samples, [&](double x, double y) { return hide.colorAt(x, y); });
}

std::vector<std::uint8_t> makeScalesHeight(const Scales& options) {
  const Hide hide(options);
  const int n = options.samples;
  const double step = 1.0 / (double(options.size) * n);
  return levelMap(options.size, [&](double x, double y) {
    double sum = 0.0;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        sum += hide.levelAt(x + (i + 0.5 - 0.5 * n) * step, y + (j + 0.5 - 0.5 * n) * step);
    return sum / (n * n);
  });
}

}  // namespace fluidtex::exemplars
