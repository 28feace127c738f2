// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/Geocentric.h"
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

/// The instances of a node (EXT_mesh_gpu_instancing): as many as its attributes have elements,
/// which must be alike. nullopt with a reason when they cannot be read.
std::optional<std::vector<glm::dmat4>> instancesOf(const Document& document,
                                                   const tinygltf::Value& extension,
                                                   std::string& problem) {
    const tinygltf::Value& attributes = member(extension, "attributes");
    const auto read = [&](const char* name, int components) {
        const int accessor = indexIn(attributes, name);
        return accessor < 0 ? std::vector<float>()
                            : readFloats(document, accessor, components, problem)
                                  .value_or(std::vector<float>{0.0F});  // one is never enough
    };
    const std::vector<float> translations = read("TRANSLATION", 3);
    const std::vector<float> rotations = read("ROTATION", 4);
    const std::vector<float> scales = read("SCALE", 3);
    const std::size_t count =
        std::max({translations.size() / 3, rotations.size() / 4, scales.size() / 3});
    const auto fits = [&](const std::vector<float>& values, std::size_t components) {
        return values.empty() || values.size() == components * count;
    };
    if (count == 0 || !fits(translations, 3) || !fits(rotations, 4) || !fits(scales, 3)) {
        if (problem.empty())
            problem = "its attributes are not there, or not equally many";
        return std::nullopt;
    }
    std::vector<glm::dmat4> out;
    out.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        tinygltf::Node node;  // the same rules as those of a node
        const auto take = [i](const std::vector<float>& from, std::size_t components) {
            std::vector<double> part;
            for (std::size_t k = 0; k < components && !from.empty(); ++k)
                part.push_back(double(from[components * i + k]));
            return part;
        };
        node.translation = take(translations, 3);
        node.rotation = take(rotations, 4);
        node.scale = take(scales, 3);
        out.push_back(transformOf(node));
    }
    return out;
}

/// EXT_georeference: -x faces east, y up and z north at the place, in geocentric coordinates.
std::optional<glm::dmat4> georeferenceOfNode(const tinygltf::Value& extension) {
    constexpr double kRadians = 3.14159265358979323846 / 180.0;
    const double nan = std::nan("");
    const double longitude = number(extension, "longitude", nan);
    const double latitude = number(extension, "latitude", nan);
    if (!(std::abs(longitude) <= 180.0) || !(std::abs(latitude) <= 90.0))
        return std::nullopt;
    const glm::dmat4 local_from_node{
        {-1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}, {0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};
    return importers::geocentric_from_local(longitude * kRadians, latitude * kRadians,
                                            number(extension, "height", 0.0)) *
           local_from_node;
}

}  // namespace

std::vector<Placed> placedMeshes(const Document& document, std::vector<Diagnostic>& diagnostics,
                                 Earth earth) {
    struct Open {
        int node;
        glm::dmat4 file_from_parent;
        std::string name;
        bool onEarth = false;
    };
    const tinygltf::Model& model = document.model();
    std::vector<Placed> out;
    std::vector<Open> open;
    const std::vector<int> first = rootsOf(model);
    for (std::size_t i = first.size(); i-- > 0;)
        open.push_back({first[i], glm::dmat4(1.0), ""});
    std::set<int> met;
    constexpr std::size_t kMostInstances = 1'000'000;
    std::size_t instances = 0;
    const auto addInstances = [&](const tinygltf::Value& extension, const std::string& object) {
        std::string problem;
        auto places = instancesOf(document, extension, problem);
        if (places && (instances += places->size()) > kMostInstances) {
            problem = fmt::format("the file has more than {} instances", kMostInstances);
            places.reset();
        }
        if (!places) {
            out.pop_back();
            remark(diagnostics, Severity::Warning, "instances-unreadable", object,
                   "its instances cannot be read: " + problem + "; they were left out");
            return;
        }
        out.back().instanced = true;
        out.back().instances = *std::move(places);
    };
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
        glm::dmat4 transform = transformOf(*node);
        bool onEarth = next.onEarth;
        if (const auto& place = extensionOf(node->extensions, "EXT_georeference");
            place.IsObject() && earth == Earth::Used) {
            const auto geocentric_from_node = georeferenceOfNode(place);
            if (!geocentric_from_node)
                remark(diagnostics, Severity::Warning, "georeference-unusable", object,
                       "its longitude and latitude are none; it is not placed by them");
            onEarth = onEarth || geocentric_from_node;
            transform = geocentric_from_node.value_or(glm::dmat4(1.0)) * transform;
        }
        transform = next.file_from_parent * transform;
        std::string name = next.name + "/" + node->name;
        if (name.size() > kLongestName)
            name.erase(0, name.size() - kLongestName);
        if (elementAt(model.meshes, node->mesh) != nullptr) {
            out.push_back({node->mesh, transform, name});
            out.back().onEarth = onEarth;
            const tinygltf::Value& instancing =
                extensionOf(node->extensions, "EXT_mesh_gpu_instancing");
            if (instancing.IsObject())
                addInstances(instancing, object);
        } else if (node->mesh != -1) {
            remark(diagnostics, Severity::Warning, "mesh-missing", object,
                   fmt::format("mesh {} does not exist", node->mesh));
        }
        for (std::size_t i = node->children.size(); i-- > 0;)
            open.push_back({node->children[i], transform, name, onEarth});
    }
    return out;
}

}  // namespace reflet::gltf
