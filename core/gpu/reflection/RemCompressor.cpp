// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/reflection/RemCompressor.h"

#include "core/base/BackgroundWork.h"

#include <algorithm>
#include <new>

namespace reflet {

/// A map that is compressed by whoever comes first; others wait.
struct RemCompressor::Entry {
    explicit Entry(RemSet::Pointer source) : map(std::move(source)) {}

    Made get() {
        const std::lock_guard lock(mutex);
        if (!made)
            made = std::make_shared<const CompressedMap>(compressed(*map));
        return made;
    }

    RemSet::Pointer map;
    std::mutex mutex;
    Made made;
};

RemCompressor::~RemCompressor() {
    {
        const std::lock_guard lock(m_mutex);
        m_ends = true;
    }
    m_more.notify_all();
}

void RemCompressor::keep(const RemSet& rems) {
    const auto& kept = rems.pointers();
    std::erase_if(m_entries, [&](const auto& entry) {
        return std::find(kept.begin(), kept.end(), entry.first) == kept.end();
    });
    std::deque<std::weak_ptr<Entry>> added;
    for (const RemSet::Pointer& map : kept) {
        auto& entry = m_entries[map];
        if (!entry) {
            entry = std::make_shared<Entry>(map);
            added.push_back(entry);
        }
    }
    if (added.empty())
        return;
    {
        const std::lock_guard lock(m_mutex);
        m_queue.insert(m_queue.end(), added.begin(), added.end());
    }
    m_more.notify_one();
    if (!m_worker.joinable())
        m_worker = std::jthread([this] { inBackground([this] { work(); }); });
}

RemCompressor::Made RemCompressor::of(const RemSet::Pointer& map) {
    auto& entry = m_entries[map];
    if (!entry)
        entry = std::make_shared<Entry>(map);
    return entry->get();
}

void RemCompressor::work() {
    for (;;) {
        std::shared_ptr<Entry> next;
        {
            std::unique_lock lock(m_mutex);
            m_more.wait(lock, [&] { return m_ends || !m_queue.empty(); });
            if (m_ends)
                return;
            next = m_queue.front().lock();  // null: forgotten meanwhile
            m_queue.pop_front();
        }
        try {
            if (next)
                static_cast<void>(next->get());
        } catch (const std::bad_alloc&) {
            continue;  // whoever asks for it tries again, and tells
        }
    }
}

}  // namespace reflet
