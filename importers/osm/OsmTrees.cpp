// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/osm/OsmTrees.h"

#include "importers/trees/TreeFields.h"

#include <fmt/format.h>

namespace reflet::osm {

namespace {

constexpr double kHighest = 130.0, kWidest = 60.0;  // metres, of any tree on Earth
constexpr double kThickest = 12.0;                  // metres around

std::optional<double> sizeOf(std::string_view text, double most) {
    const auto size = trees::parseSize(text);
    return size && *size <= most ? size : std::nullopt;
}

trees::Tree treeOf(const Node& node) {
    trees::Tree tree;
    tree.outline.id = fmt::format("node/{}", node.id);
    tree.place = node.place;
    if (!tree.place)
        tree.notes.emplace_back(importers::Issue::BadVertex, "its place");
    tree.height = sizeOf(node.tags.first({"height", "est_height"}), kHighest);
    tree.crown = sizeOf(node.tags["diameter_crown"], kWidest);
    if (const auto around = sizeOf(node.tags["circumference"], kThickest))
        tree.trunkRadius = *around / (2.0 * kPi);
    tree.needles = node.tags["leaf_type"] == "needleleaved" ||
                   (node.tags["leaf_type"].empty() &&
                    trees::hasNeedles(node.tags.first({"genus", "species", "taxon"})));
    return tree;
}

}  // namespace

bool isTree(const Tags& tags) {
    return tags["natural"] == "tree";
}

OsmTrees treesOf(const OsmData& data) {
    OsmTrees found;
    found.trees.reserve(data.nodes.size());
    for (const Node& node : data.nodes) {
        found.trees.push_back(treeOf(node));
        found.heightAssumed += found.trees.back().height ? 0 : 1;
        found.crownAssumed += found.trees.back().crown ? 0 : 1;
    }
    return found;
}

}  // namespace reflet::osm
