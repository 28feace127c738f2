// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/CompressedMap.h"
#include "core/environment/RemSet.h"

#include <condition_variable>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

namespace reflet {

/// Compresses the maps of a set on a thread of its own, of low priority, before they are asked for:
/// some 20 ms each, which a frame should not wait for. For one thread that asks.
class RemCompressor {
public:
    using Made = std::shared_ptr<const CompressedMap>;

    RemCompressor() = default;
    ~RemCompressor();
    RemCompressor(const RemCompressor&) = delete;
    RemCompressor& operator=(const RemCompressor&) = delete;

    /// Begins with the maps that are new in the set, and forgets those that it does not hold.
    void keep(const RemSet& rems);
    /// A map compressed: at once where that was done before, else when it is done.
    [[nodiscard]] Made of(const RemSet::Pointer& map);

private:
    struct Entry;

    void work();

    std::map<RemSet::Pointer, std::shared_ptr<Entry>> m_entries;
    std::mutex m_mutex;  ///< of what follows
    std::condition_variable m_more;
    std::deque<std::weak_ptr<Entry>> m_queue;
    bool m_ends = false;
    std::jthread m_worker;  ///< last: ends before the rest goes
};

}  // namespace reflet
