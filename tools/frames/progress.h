// Progress of a run: a bar on a terminal, one line per frame elsewhere.
#pragma once

#include <chrono>
#include <string>

namespace fluidtex::tools {

class Progress {
 public:
  // Frames first..last are to be made. quiet: prints nothing.
  Progress(int first, int last, bool quiet);
  ~Progress();

  // Stage `stage` of frame `frame` is done to the share `part`, 0..1. Redraws at most ten times a second.
  void update(int frame, const std::string& stage, double part = 0.0);
  // The frame is done; `summary` is printed with it.
  void frameDone(int frame, const std::string& summary);

 private:
  using Clock = std::chrono::steady_clock;
  std::string timeLeft() const;

  int m_first, m_last;
  bool m_quiet;
  int m_done = 0;
  Clock::time_point m_start, m_drawn;
};

// "45 s", "3 min 20 s", "2 h 5 min".
std::string humanDuration(double seconds);

}  // namespace fluidtex::tools
