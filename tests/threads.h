// Running on a number of threads, whatever the machine has.
#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

// f() with that many threads, in an arena with as many places: loops are divided by those, as they are on a
// machine with so many cores.
template <class F>
auto onThreads(int threads, const F& f) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  return arena.execute(f);
}
