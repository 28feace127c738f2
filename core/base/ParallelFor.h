// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>

namespace reflet {

/// Runs body(first, last) over disjoint half-open pieces of [begin, end), in any order, on all
/// threads that are allowed; returns when all are done. The one way in which Reflet goes parallel:
/// oneTBB normally, std::thread in the thread-sanitizer build (Debian's TBB is not instrumented).
/// An exception of a body reaches the caller. grain: smallest piece worth a task, at least 1.
void parallelFor(std::size_t begin, std::size_t end, std::size_t grain,
                 const std::function<void(std::size_t first, std::size_t last)>& body);

/// Limits the threads of all later parallel loops; 0 means as many as there are cores.
void setThreadLimit(int threads);
/// The number of threads that a parallel loop may use now, at least 1.
[[nodiscard]] int threadLimit();

}  // namespace reflet
