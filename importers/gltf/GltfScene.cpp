// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/GltfDocument.h"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace reflet::gltf {

namespace {

constexpr std::size_t kLongestName = 200;

bool areFinite(const std::vector<double>& values, std::size_t count) {
    return values.size() == count &&
           std::all_of(values.begin(), values.end(), [](double d) { return std::isfinite(d); });
}

/// Local transform of a node (glTF 2.0, section 3.5.3).
glm::dmat4 transformOf(const tinygltf::Node& node) {
    glm::dmat4 out(1.0);
    if (areFinite(node.matrix, 16)) {
        for (std::size_t i = 0; i < 16; ++i)
            out[int(i / 4)][int(i % 4)] = node.matrix[i];
        return out;
    }
    if (areFinite(node.rotation, 4)) {
        const auto& r = node.rotation;
        const glm::dquat q(r[3], r[0], r[1], r[2]);
        if (glm::length(q) > 1e-9)
            out = glm::mat4_cast(glm::normalize(q));
    }
    if (areFinite(node.scale, 3)) {
        for (int i = 0; i < 3; ++i)
            out[i] *= node.scale[std::size_t(i)];
    }
    if (areFinite(node.translation, 3)) {
        const auto& t = node.translation;
        out[3] = glm::dvec4(t[0], t[1], t[2], 1.0);
    }
    return out;
}

std::vector<int> rootsOf(const tinygltf::Model& model) {
    const tinygltf::Scene* scene = elementAt(model.scenes, std::max(model.defaultScene, 0));
    if (scene != nullptr && !scene->nodes.empty())
        return scene->nodes;
    // Without a scene: every node that is nobody's child.
    std::set<int> children;
    for (const tinygltf::Node& node : model.nodes)
        children.insert(node.children.begin(), node.children.end());
    std::vector<int> out;
    for (int i = 0; i < int(model.nodes.size()); ++i) {
        if (children.count(i) == 0)
            out.push_back(i);
    }
    if (out.empty() && !model.nodes.empty())
        out.push_back(0);
    return out;
}

}  // namespace

std::vector<Placed> placedMeshes(const Document& document, std::vector<Diagnostic>& diagnostics) {
    struct Open {
        int node;
        glm::dmat4 file_from_parent;
        std::string name;
    };
    const tinygltf::Model& model = document.model();
    std::vector<Placed> out;
    std::vector<Open> open;
    const std::vector<int> first = rootsOf(model);
    for (std::size_t i = first.size(); i-- > 0;)
        open.push_back({first[i], glm::dmat4(1.0), ""});
    std::set<int> met;
    while (!open.empty()) {
        const Open next = std::move(open.back());
        open.pop_back();
        const tinygltf::Node* node = elementAt(model.nodes, next.node);
        const std::string object = fmt::format("node {}", next.node);
        if (node == nullptr) {
            remark(diagnostics, Severity::Warning, "node-missing", object,
                   "it does not exist; left out");
            continue;
        }
        if (!met.insert(next.node).second) {
            remark(diagnostics, Severity::Warning, "node-loop", object,
                   "it is its own ancestor, or has two parents; shown once");
            continue;
        }
        const glm::dmat4 transform = next.file_from_parent * transformOf(*node);
        std::string name = next.name + "/" + node->name;
        if (name.size() > kLongestName)
            name.erase(0, name.size() - kLongestName);
        if (elementAt(model.meshes, node->mesh) != nullptr) {
            out.push_back({node->mesh, transform, name});
        } else if (node->mesh != -1) {
            remark(diagnostics, Severity::Warning, "mesh-missing", object,
                   fmt::format("mesh {} does not exist", node->mesh));
        }
        for (std::size_t i = node->children.size(); i-- > 0;)
            open.push_back({node->children[i], transform, name});
    }
    return out;
}

}  // namespace reflet::gltf
