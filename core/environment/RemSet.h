// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/EnvironmentMap.h"

#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

namespace reflet {

/// Reference environment maps that are shared, not copied: sets that differ in one map hold the
/// others in common. Copying a set copies pointers. The maps never change; safe to read from
/// several threads.
class RemSet {
public:
    using Pointer = std::shared_ptr<const ReferenceEnvironmentMap>;

    RemSet() = default;
    RemSet(std::initializer_list<ReferenceEnvironmentMap> maps) {
        for (const auto& map : maps)
            add(map);
    }

    void add(ReferenceEnvironmentMap map) {
        add(std::make_shared<const ReferenceEnvironmentMap>(std::move(map)));
    }
    /// map: not null.
    void add(Pointer map) { m_maps.push_back(std::move(map)); }

    [[nodiscard]] std::size_t size() const { return m_maps.size(); }
    [[nodiscard]] bool empty() const { return m_maps.empty(); }
    [[nodiscard]] const ReferenceEnvironmentMap& operator[](std::size_t i) const {
        return *m_maps[i];
    }
    [[nodiscard]] const std::vector<Pointer>& pointers() const { return m_maps; }

    /// The same maps, not merely equal ones.
    friend bool operator==(const RemSet&, const RemSet&) = default;

private:
    std::vector<Pointer> m_maps;
};

}  // namespace reflet
