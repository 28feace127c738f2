// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/ObjectTree.h"

#include <fmt/core.h>

#include <algorithm>
#include <unordered_map>

namespace reflet::importers {

namespace {

/// Cuts every circle of parents at the object of it that is met first.
void cutCycles(ObjectTree& tree, ImportReport& report) {
    enum class State : std::uint8_t { New, OnPath, Done };
    std::vector<State> state(tree.parent.size(), State::New);
    std::vector<std::uint32_t> path;
    for (std::uint32_t start = 0; start < tree.parent.size(); ++start) {
        path.clear();
        std::uint32_t at = start;
        while (at != kNone && state[at] == State::New) {
            state[at] = State::OnPath;
            path.push_back(at);
            at = tree.parent[at];
        }
        if (at != kNone && state[at] == State::OnPath) {
            tree.parent[at] = kNone;
            report.note(at, Issue::ParentCycle);
        }
        for (const std::uint32_t passed : path)
            state[passed] = State::Done;
    }
}

/// Takes leaves away until nothing is left (Kahn's order, upside down).
std::vector<std::uint32_t> childrenFirst(const std::vector<std::uint32_t>& parent) {
    std::vector<std::uint32_t> pending(parent.size(), 0);
    for (const std::uint32_t p : parent) {
        if (p != kNone)
            ++pending[p];
    }
    std::vector<std::uint32_t> order;
    order.reserve(parent.size());
    for (std::uint32_t i = 0; i < parent.size(); ++i) {
        if (pending[i] == 0)
            order.push_back(i);
    }
    for (std::size_t next = 0; next < order.size(); ++next) {
        const std::uint32_t above = parent[order[next]];
        if (above != kNone && --pending[above] == 0)
            order.push_back(above);
    }
    return order;
}

}  // namespace

ObjectTree makeObjectTree(const std::vector<ObjectOutline>& objects, ImportReport& report) {
    std::unordered_map<std::string_view, std::uint32_t> indexOf;
    indexOf.reserve(objects.size());
    for (std::uint32_t i = 0; i < objects.size(); ++i)
        indexOf.try_emplace(objects[i].id, i);

    ObjectTree tree;
    tree.parent.assign(objects.size(), kNone);
    for (std::uint32_t i = 0; i < objects.size(); ++i) {
        for (const std::string& id : objects[i].parentIds) {
            const auto found = indexOf.find(id);
            if (found == indexOf.end())
                report.note(i, Issue::ParentMissing, fmt::format("{:.80}", id));
            else if (tree.parent[i] == kNone)
                tree.parent[i] = found->second;
        }
    }
    cutCycles(tree, report);
    tree.childrenFirst = childrenFirst(tree.parent);
    return tree;
}

std::vector<bool> objectsOfTypes(const std::vector<ObjectOutline>& objects, const ObjectTree& tree,
                                 const std::vector<std::string>& types) {
    std::vector<bool> wanted(objects.size(), types.empty());
    if (types.empty())
        return wanted;
    enum class State : std::uint8_t { Unknown, No, Yes };
    std::vector<State> state(objects.size(), State::Unknown);
    std::vector<std::uint32_t> path;
    for (std::uint32_t i = 0; i < objects.size(); ++i) {
        path.clear();
        std::uint32_t at = i;
        State found = State::No;
        for (; at != kNone; at = tree.parent[at]) {
            if (state[at] != State::Unknown) {
                found = state[at];
                break;
            }
            path.push_back(at);
            if (std::find(types.begin(), types.end(), objects[at].typeName) != types.end()) {
                found = State::Yes;
                break;
            }
        }
        // What holds for an ancestor that is of a type asked for holds for all below it; the path
        // ends at the first such ancestor, or at the root.
        for (const std::uint32_t passed : path)
            state[passed] = found;
        wanted[i] = found == State::Yes;
    }
    return wanted;
}

}  // namespace reflet::importers
