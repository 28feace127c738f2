// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <utility>

namespace reflet {

/// Runs long work that nobody waits for, beside a window that must stay fluent: on a thread of its
/// own, of low priority, whose parallel loops leave one core to others (with two cores: run on that
/// thread alone). Returns when it is done; its exception reaches the caller.
void inBackground(const std::function<void()>& work);

/// The same with a result: work() gives a value.
template <class Work>
[[nodiscard]] auto resultInBackground(const Work& work) -> decltype(work()) {
    std::optional<decltype(work())> made;
    inBackground([&] { made.emplace(work()); });
    return std::move(*made);
}

}  // namespace reflet
