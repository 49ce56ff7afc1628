/// \file
/// In place of OpenMP's header: a worker of a browser has one thread.
#pragma once

/// The only thread.
inline int omp_get_max_threads() {
  return 1;
}
/// See omp_get_max_threads.
inline int omp_get_thread_num() {
  return 0;
}
