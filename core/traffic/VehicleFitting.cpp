// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/traffic/VehicleFitting.h"

#include "core/traffic/MeshCutting.h"
#include "core/traffic/PartMesh.h"
#include "core/traffic/VehicleParts.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>

namespace reflet {
namespace {

constexpr double kLongestBody = 8.0;  // metres
constexpr double kWheelbase = 0.58;   // share of a rigid vehicle's length between its axles
constexpr double kPaintShare = 0.03;  // of the area: larger surfaces are taken for paint
constexpr double kDarkShare = 0.01;   // of the area: dark regions of a texture, windows
constexpr float kDark = 0.02F;        // linear luminance
constexpr float kGlossy = 0.45F;      // metals rougher than this do not mirror
constexpr float kSeeThrough = 0.7F;   // alpha
const glm::vec3 kDarkPane(0.05F);     // what a pane lets through when nothing lies behind it

bool names(const std::string& text, std::initializer_list<const char*> words) {
    return std::any_of(words.begin(), words.end(),
                       [&](const char* word) { return text.find(word) != std::string::npos; });
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

float luminance(const glm::vec3& c) {
    return glm::dot(c, glm::vec3(0.2126F, 0.7152F, 0.0722F));
}

std::vector<double> areaShares(const GltfModel& model) {
    std::vector<double> area(model.materials.size(), 0.0);
    double sum = 0.0;
    for (std::size_t i = 0; i < model.triangles.size(); ++i) {
        const glm::uvec3& t = model.triangles[i];
        const glm::vec3& a = model.positions[t.x];
        const double twice =
            double(glm::length(glm::cross(model.positions[t.y] - a, model.positions[t.z] - a)));
        area[model.triangleMaterial[i]] += twice;
        sum += twice;
    }
    for (double& a : area)
        a = sum > 0.0 ? a / sum : 0.0;
    return area;
}

/// Area of all colours of the material together.
double wholeShare(const GltfModel& model, const std::vector<double>& shares,
                  const std::string& name) {
    double sum = 0.0;
    for (std::size_t i = 0; i < model.materials.size(); ++i)
        sum += model.materials[i].name == name ? shares[i] : 0.0;
    return sum;
}

PaintGuess guessOf(const GltfModel& model, const std::vector<double>& shares, std::size_t i) {
    const GltfMaterial& m = model.materials[i];
    const std::string name = lower(m.name);
    PaintGuess guess;
    guess.share = shares[i];
    guess.mirrors = (m.metallic >= 0.5F && m.roughness < kGlossy) || m.clearCoat > 0.3F;
    const auto is = [&](PaintRole role, const char* reason) {
        guess.role = role;
        guess.reason = reason;
        return guess;
    };
    if (names(name, {"glass", "window", "windscreen", "windshield", "vitre", "fenster", "scheibe",
                     "vidro", "glazing"}))
        return is(PaintRole::Glass, "its name says glass");
    if (m.transmission > 0.2F || m.alpha < kSeeThrough)
        return is(PaintRole::Glass, "the file lets one see through it");
    if (names(name, {"tyre", "tire", "tier", "reifen", "pneu", "rubber", "gummi", "plastic", "void",
                     "interior", "seat", "fabric", "cloth", "leather", "chassis", "underbody",
                     "carpet", "floor"}))
        return is(PaintRole::Dull, "its name says that it is dull");
    const double whole = wholeShare(model, shares, m.name);
    if (m.textured && luminance(m.color) < kDark && shares[i] > kDarkShare &&
        whole > 3.0 * kDarkShare && shares[i] < 0.6 * whole)
        return is(PaintRole::Glass, "a dark region of its texture, as windows are painted");
    if (names(name, {"chrome", "mirror", "espelho", "steel", "rim"}) ||
        (!m.textured && guess.mirrors && m.metallic >= 0.5F))
        return is(PaintRole::AsInFile, "bare metal");
    if (names(name, {"paint", "body", "lack", "karosserie", "carrosserie", "roof", "hood", "door",
                     "bonnet", "coat"}))
        return is(PaintRole::Paint, "its name says bodywork");
    if (whole > kPaintShare)
        return is(PaintRole::Paint, "it covers much of the vehicle");
    return is(PaintRole::AsInFile, "it covers little");
}

VehicleMaterial materialOf(const GltfMaterial& m, const PaintGuess& guess, bool coat) {
    VehicleMaterial out;
    out.name = m.name;
    out.baseColor = m.color;
    out.clearCoat = m.clearCoat;
    out.emission = m.emission;
    // Reflections are sharp: a rough metal mirrors in proportion to its polish.
    out.metallic = m.metallic * std::max(0.0F, 1.0F - m.roughness);
    const bool seeThrough = m.transmission > 0.2F || m.alpha < kSeeThrough;
    if (seeThrough || (coat && guess.role == PaintRole::Glass)) {
        out.glass = 1.0F;
        out.metallic = 0.12F;
        out.clearCoat = 0.0F;
        // Tinted where the file's pane is, dark where the file paints a window onto a wall.
        out.baseColor = seeThrough ? glm::mix(glm::vec3(0.55F), m.color, 0.4F) : kDarkPane;
    } else if (coat && guess.role == PaintRole::Paint) {
        out.clearCoat = 1.0F;
        out.metallic = std::min(out.metallic, 0.12F);
    } else if (guess.role == PaintRole::Dull && coat) {
        out.metallic = 0.0F;
    }
    return out;
}

PartMesh fitted(const GltfModel& model, const VehicleModel& fit) {
    const double c = std::cos(fit.heading);
    const double s = std::sin(fit.heading);
    const glm::dmat3 turn(c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0);
    const glm::dmat3 vehicle_from_file = turn * uprightFromFile(fit.up);
    PartMesh mesh;
    for (std::size_t v = 0; v < model.positions.size(); ++v) {
        mesh.positions.emplace_back(
            vehicle_from_file * (glm::dvec3(model.positions[v]) * fit.scale) + fit.offset);
        mesh.normals.push_back(
            glm::normalize(glm::vec3(vehicle_from_file * glm::dvec3(model.normals[v]))));
        mesh.surface.emplace_back(0.0F);
    }
    mesh.triangles = model.triangles;
    mesh.material = model.triangleMaterial;
    return mesh;
}

VehicleBody bodyOf(PartMesh mesh, double middle, double length, float top) {
    VehicleBody body = toBody(moved(std::move(mesh), {-float(middle), 0.0F, 0.0F}), 0.0F, top);
    body.offset = middle;
    body.pivotSpan = kWheelbase * length;
    body.pivotMiddle = -middle;
    return body;
}

}  // namespace

std::vector<PaintGuess> guessPaint(const GltfModel& model) {
    const std::vector<double> shares = areaShares(model);
    std::vector<PaintGuess> out;
    for (std::size_t i = 0; i < model.materials.size(); ++i)
        out.push_back(guessOf(model, shares, i));
    return out;
}

glm::dmat3 uprightFromFile(VehicleUp up) {
    // Columns: where the file's x, y and z go. Forward is +Z where Y (or X) is up, as in glTF, and
    // -Y where Z is up, as modelling programs have it.
    switch (up) {
        case VehicleUp::PlusY:
            return {0, 1, 0, 0, 0, 1, 1, 0, 0};
        case VehicleUp::MinusY:
            return {0, -1, 0, 0, 0, -1, 1, 0, 0};
        case VehicleUp::PlusZ:
            return {0, 1, 0, -1, 0, 0, 0, 0, 1};
        case VehicleUp::MinusZ:
            return {0, -1, 0, -1, 0, 0, 0, 0, -1};
        case VehicleUp::PlusX:
            return {0, 0, 1, 0, -1, 0, 1, 0, 0};
        case VehicleUp::MinusX:
            return {0, 0, -1, 0, 1, 0, 1, 0, 0};
    }
    return glm::dmat3(1.0);
}

Vehicle makeVehicle(const GltfModel& model, const VehicleModel& fit) {
    Vehicle vehicle;
    vehicle.name = fit.id;
    const std::vector<PaintGuess> guesses = guessPaint(model);
    for (std::size_t i = 0; i < model.materials.size(); ++i)
        vehicle.materials.push_back(materialOf(model.materials[i], guesses[i], fit.coat));
    PartMesh mesh = fitted(model, fit);
    Box box;
    for (const glm::vec3& p : mesh.positions)
        box.add(glm::dvec3(p));
    const double length = box.size().x;
    const int count = std::clamp(int(std::ceil(length / kLongestBody - 1e-6)), 1, 64);
    const auto top = float(box.max.z);
    // From the rear on: what lies behind each cut becomes a body.
    for (int i = 0; i < count; ++i) {
        const double from = box.min.x + length * double(i) / double(count);
        const double to = box.min.x + length * double(i + 1) / double(count);
        PartMesh rear = std::move(mesh);
        mesh = PartMesh{};
        if (i + 1 < count) {
            const glm::vec3 shift(float(to), 0.0F, 0.0F);
            SplitMesh parts = splitAcross(moved(std::move(rear), -shift));
            rear = moved(std::move(parts.rear), shift);
            mesh = moved(std::move(parts.front), shift);
        }
        if (!rear.triangles.empty())
            vehicle.bodies.push_back(bodyOf(std::move(rear), 0.5 * (from + to), length, top));
    }
    std::reverse(vehicle.bodies.begin(), vehicle.bodies.end());
    return vehicle;
}

}  // namespace reflet
