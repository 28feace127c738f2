// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/ParallelFor.h"

#include "core/base/BackgroundWork.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>

#if defined(__linux__)
#include <sys/resource.h>
#include <unistd.h>
#endif

#if defined(REFLET_STD_THREAD_PARALLEL)
#include <mutex>
#include <vector>
#else
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <memory>
#endif

namespace reflet {

namespace {

std::atomic<int> g_threadLimit{0};

/// For good: raising it again takes a privilege.
void lowerPriorityOfThisThread() {
#if defined(__linux__)
    constexpr int kNice = 10;
    static_cast<void>(setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNice));
#endif
}

thread_local int t_threads = 0;  ///< that loops begun by this thread may use; 0: as for all

/// Runs work such that its parallel loops use at most so many threads.
void withThreads(int threads, const std::function<void()>& work) {
    t_threads = threads;
#if defined(REFLET_STD_THREAD_PARALLEL)
    work();
#else
    tbb::task_arena(threads).execute(work);
#endif
}

}  // namespace

int threadLimit() {
    if (t_threads > 0)
        return t_threads;
    const int limit = g_threadLimit.load();
    if (limit > 0)
        return limit;
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void inBackground(const std::function<void()>& work) {
    std::exception_ptr failure;
    std::jthread([&] {
        try {
            lowerPriorityOfThisThread();
            withThreads(std::max(1, threadLimit() - 1), work);
        } catch (...) {
            failure = std::current_exception();
        }
    }).join();
    if (failure)
        std::rethrow_exception(failure);
}

#if defined(REFLET_STD_THREAD_PARALLEL)

void setThreadLimit(int threads) {
    g_threadLimit = std::max(0, threads);
}

void parallelFor(std::size_t begin, std::size_t end, std::size_t grain,
                 const std::function<void(std::size_t, std::size_t)>& body) {
    if (begin >= end)
        return;
    grain = std::max<std::size_t>(1, grain);
    std::atomic<std::size_t> next{begin};
    std::mutex mutex;
    std::exception_ptr failure;
    const auto work = [&] {
        try {
            for (std::size_t first = next.fetch_add(grain); first < end;
                 first = next.fetch_add(grain)) {
                body(first, std::min(end, first + grain));
            }
        } catch (...) {
            const std::scoped_lock lock(mutex);
            if (!failure)
                failure = std::current_exception();
        }
    };
    std::vector<std::jthread> threads;
    for (int i = 1; i < threadLimit(); ++i)
        threads.emplace_back(work);
    work();
    threads.clear();
    if (failure)
        std::rethrow_exception(failure);
}

#else

void setThreadLimit(int threads) {
    static std::unique_ptr<tbb::global_control> control;
    g_threadLimit = std::max(0, threads);
    control = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(threadLimit()));
}

void parallelFor(std::size_t begin, std::size_t end, std::size_t grain,
                 const std::function<void(std::size_t, std::size_t)>& body) {
    if (begin >= end)
        return;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, std::max<std::size_t>(1, grain)),
                      [&](const auto& range) { body(range.begin(), range.end()); });
}

#endif

}  // namespace reflet
