// How much liquid there must be, frame by frame: what was poured, and what sources, drains, sides and events
// can have changed of it.
#pragma once

#include "tools/stress_scenes/surroundings.h"

#include <vector>

namespace fluidtex::stress {

class VolumeBudget {
 public:
  VolumeBudget(const sim::Options& options, const Surroundings& surroundings);

  // Volumes, m3, are those of liquid and volume deficit together. Each call gives how far outside of what can
  // be the volume is: above 0 where there is too much, below 0 where there is too little. Of the first frame:
  // beside what the shapes themselves hold.
  double start(double volume);
  // Between two frames, at these times.
  double advance(double from, double to, double volume);

  // The most there has been.
  double most() const { return m_most; }
  // No more than this can be seen of a volume: a hundredth of it, and one cell.
  double tolerance() const;

 private:
  const sim::Options& m_options;
  const Surroundings& m_surroundings;
  double m_low = 0.0, m_high = 0.0, m_most = 0.0;
  double m_slack = 0.0;         // of sources, m3
  std::vector<double> m_given;  // least that each source has given, m3
};

// Whether something happens between two frames, at the second one's time too: of times that the solver takes
// for one.
bool happens(double time, double from, double to, double frameRate);

}  // namespace fluidtex::stress
