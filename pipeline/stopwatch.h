// Times of stages.
#pragma once

#include <chrono>
#include <functional>

namespace fluidtex::pipeline {

// Seconds of a clock that only goes forward; only differences mean something.
inline double wallSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Adds the time of its own life to `seconds`.
class Stopwatch {
 public:
  // clock: seconds; empty: wall time.
  explicit Stopwatch(double& seconds, const std::function<double()>& clock = {})
      : m_seconds(seconds), m_clock(clock ? clock : wallSeconds), m_start(m_clock()) {}
  ~Stopwatch() { m_seconds += m_clock() - m_start; }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& m_seconds;
  std::function<double()> m_clock;
  double m_start;
};

}  // namespace fluidtex::pipeline
