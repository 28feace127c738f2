// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/traffic/VehicleProposal.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <optional>

namespace reflet {
namespace {

/// Usual sizes in metres: lengths that are believed, and the middle of each measure.
struct KindSize {
    VehicleKind kind;
    double shortest, longest, length, width, height, widest;
};
constexpr std::array<KindSize, 3> kKinds{{
    {VehicleKind::Car, 2.4, 7.0, 4.4, 1.85, 1.5, 2.6},
    {VehicleKind::Bus, 8.0, 19.5, 12.0, 2.7, 3.1, 3.6},
    {VehicleKind::Tram, 14.0, 75.0, 33.0, 2.6, 3.6, 3.6},
}};

struct Unit {
    const char* name;
    double metres;
};
constexpr std::array<Unit, 5> kUnits{{
    {"metres", 1.0},
    {"centimetres", 0.01},
    {"millimetres", 0.001},
    {"inches", 0.0254},
    {"feet", 0.3048},
}};

constexpr double kBaseShare = 0.5;   // of the area: a dull material this large is a base
constexpr double kBusRatio = 0.30;   // of width to length: narrower is a bus
constexpr double kTramRatio = 0.12;  // and narrower still a tram

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

bool names(const std::string& text, std::initializer_list<const char*> words) {
    return std::any_of(words.begin(), words.end(),
                       [&](const char* word) { return text.find(word) != std::string::npos; });
}

/// Middle of the area of the parts whose names hold one of the words, upright frame.
std::optional<glm::dvec3> middleOf(const GltfModel& model, const glm::dmat3& upright,
                                   std::initializer_list<const char*> words) {
    glm::dvec3 sum(0.0);
    int count = 0;
    for (const GltfPart& part : model.parts) {
        if (part.triangleCount > 0 && names(lower(part.name), words)) {
            sum += upright * part.bounds.center();
            ++count;
        }
    }
    return count > 0 ? std::optional(sum / double(count)) : std::nullopt;
}

Box uprightBox(const GltfModel& model, const glm::dmat3& upright) {
    Box box;
    for (const glm::uvec3& t : model.triangles) {
        for (int k = 0; k < 3; ++k)
            box.add(upright * glm::dvec3(model.positions[t[k]]));
    }
    return box;
}

/// Metres (of the file) across at the lowest and the highest fifth.
std::pair<double, double> widths(const GltfModel& model, const glm::dmat3& upright, const Box& box,
                                 int across) {
    const double h = box.size().z;
    Box low;
    Box high;
    for (const glm::vec3& p : model.positions) {
        const glm::dvec3 q = upright * glm::dvec3(p);
        if (q.z < box.min.z + 0.2 * h)
            low.add(q);
        if (q.z > box.max.z - 0.2 * h)
            high.add(q);
    }
    return {low.size()[across], high.size()[across]};
}

void proposeUp(const GltfModel& model, VehicleProposal& out) {
    const glm::dvec3 size = model.bounds.size();
    const bool lying = size.y > 1.2 * size.x && size.y > 1.2 * size.z;
    out.model.up = lying ? VehicleUp::PlusZ : VehicleUp::PlusY;
    out.upReason = lying ? "The file is longest along its Y axis, so Z is taken for up."
                         : "Y is up, as glTF says.";
    const glm::dmat3 upright = uprightFromFile(out.model.up);
    const Box box = uprightBox(model, upright);
    const VehicleUp other = lying ? VehicleUp::MinusZ : VehicleUp::MinusY;
    const auto wheels =
        middleOf(model, upright, {"wheel", "tyre", "tire", "tier", "reifen", "roue"});
    if (wheels) {
        if (wheels->z > box.center().z + 0.1 * box.size().z) {
            out.model.up = other;
            out.upReason = "Its wheels are at the top: it is turned over.";
        } else {
            out.upReason += " Its wheels are at the bottom.";
        }
        return;
    }
    const auto [low, high] = widths(model, upright, box, box.size().x < box.size().y ? 0 : 1);
    if (high > 1.25 * low) {
        out.model.up = other;
        out.upReason = "It is wider at the top than at the bottom: it is turned over.";
        out.concerns.emplace_back("Check that it stands on its wheels; else flip it.");
    }
}

/// The kind by the file's names, else by proportions.
VehicleKind kindOf(const GltfModel& model, double ratio) {
    std::string all = lower(model.name);
    for (const GltfMaterial& m : model.materials)
        all += " " + lower(m.name);
    if (names(all, {"tram", "streetcar", "light rail"}))
        return VehicleKind::Tram;
    if (names(all, {"bus", "coach", "truck", "lorry"}))
        return VehicleKind::Bus;
    return ratio < kTramRatio  ? VehicleKind::Tram
           : ratio < kBusRatio ? VehicleKind::Bus
                               : VehicleKind::Car;
}

void proposeSize(const GltfModel& model, const glm::dvec3& size, VehicleProposal& out) {
    const double length = std::max(size.x, size.y);
    const double width = std::min(size.x, size.y);
    out.kind = kindOf(model, length > 0.0 ? width / length : 1.0);
    const KindSize& usual = kKinds[std::size_t(out.kind)];
    const std::string kind = toString(out.kind);
    for (const Unit& unit : kUnits) {
        const double metres = length * unit.metres;
        if (metres >= usual.shortest && metres <= usual.longest &&
            width * unit.metres <= usual.widest && size.z * unit.metres <= 1.6 * usual.height) {
            out.model.scale = unit.metres;
            out.sizeReason =
                fmt::format("Taken as {}: {:.2f} m long, right for a {}.", unit.name, metres, kind);
            return;
        }
    }
    // No usual unit fits: the mean of what its length, width and height would ask for.
    const double product = (usual.length / std::max(length, 1e-9)) *
                           (usual.width / std::max(width, 1e-9)) *
                           (usual.height / std::max(size.z, 1e-9));
    out.model.scale = std::clamp(std::cbrt(product), 1e-6, 1e6);
    // Two digits: it is a guess and should look like one.
    const double digits = std::pow(10.0, std::floor(std::log10(out.model.scale)) - 1.0);
    out.model.scale = std::round(out.model.scale / digits) * digits;
    out.sizeReason = fmt::format(
        "It is {:.4g} units long, in no usual unit right for a {}; scaled to the size of one, "
        "{:.1f} m.",
        length, kind, length * out.model.scale);
    out.concerns.push_back("Check its length of " +
                           fmt::format("{:.1f} m.", length * out.model.scale));
}

const char* axisName(VehicleUp up, bool alongX, bool positive) {
    // The upright frame's x comes from the file's Z (or -Y), its y from X.
    const bool zUp = up == VehicleUp::PlusZ || up == VehicleUp::MinusZ;
    if (alongX)
        return zUp ? (positive ? "-y" : "+y") : (positive ? "+z" : "-z");
    const bool mirrored = up == VehicleUp::MinusY || up == VehicleUp::MinusZ;
    return positive != mirrored ? "+x" : "-x";
}

void proposeFront(const GltfModel& model, const glm::dmat3& upright, const Box& box,
                  VehicleProposal& out) {
    const bool alongX = box.size().x >= box.size().y;
    const int axis = alongX ? 0 : 1;
    const double half = 0.5 * box.size()[axis];
    const auto front = middleOf(model, upright,
                                {"front", "headlight", "head_light", "headlamp", "bonnet", "hood",
                                 "windscreen", "windshield", "grill", "phare"});
    const auto rear = middleOf(model, upright, {"rear", "back", "tail", "trunk", "exhaust"});
    double lean = 0.0;
    if (front)
        lean += (front->operator[](axis) - box.center()[axis]) / half;
    if (rear)
        lean -= (rear->operator[](axis) - box.center()[axis]) / half;
    bool positive = lean >= 0.0;
    out.frontCertain = std::abs(lean) > 0.25;
    if (out.frontCertain) {
        out.frontReason = "Told by the names of its parts.";
    } else if (out.kind == VehicleKind::Car) {
        // The cabin of a car lies behind the middle, the bonnet is low.
        double sum = 0.0;
        double count = 0.0;
        for (const glm::vec3& p : model.positions) {
            const glm::dvec3 q = upright * glm::dvec3(p);
            if (q.z > box.max.z - 0.25 * box.size().z) {
                sum += q[axis] - box.center()[axis];
                count += 1.0;
            }
        }
        positive = count > 0.0 && std::abs(sum) > 0.02 * half * count ? sum < 0.0 : true;
        out.frontReason = "Guessed: the cabin of a car lies towards its rear.";
    } else {
        positive = true;
        out.frontReason = alongX ? "Guessed: glTF files drive towards +Z."
                                 : "Guessed: nothing tells one end from the other.";
    }
    if (!out.frontCertain)
        out.concerns.emplace_back("Check that it drives forward; else turn it by 180 degrees.");
    out.front = axisName(out.model.up, alongX, positive);
    const double angle = alongX ? (positive ? 0.0 : kPi) : (positive ? -kPi / 2.0 : kPi / 2.0);
    out.model.heading = angle;
}

/// Lowest point on the ground, middle of the plan at the origin.
void proposeGround(const GltfModel& model, VehicleProposal& out) {
    const double c = std::cos(out.model.heading);
    const double s = std::sin(out.model.heading);
    const glm::dmat3 turn(c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0);
    const Box box = uprightBox(model, turn * uprightFromFile(out.model.up));
    const glm::dvec3 size = box.size() * out.model.scale;
    out.length = size.x;
    out.width = size.y;
    out.height = size.z;
    out.model.offset = -glm::dvec3(box.center().x, box.center().y, box.min.z) * out.model.scale;
    out.groundReason =
        fmt::format("Its lowest point is set on the ground ({:+.2f} m).", out.model.offset.z);
}

void proposePaint(const GltfModel& model, VehicleProposal& out) {
    const std::vector<PaintGuess> guesses = guessPaint(model);
    double paint = 0.0;
    double glass = 0.0;
    for (std::size_t i = 0; i < guesses.size(); ++i) {
        const PaintGuess& guess = guesses[i];
        const bool gets = guess.role == PaintRole::Paint || guess.role == PaintRole::Glass;
        out.paint.push_back({model.materials[i].name, guess});
        paint += guess.role == PaintRole::Paint ? guess.share : 0.0;
        glass += guess.role == PaintRole::Glass ? guess.share : 0.0;
        out.reflectingBefore += guess.mirrors || model.materials[i].transmission > 0.2F ||
                                        model.materials[i].alpha < 0.7F
                                    ? guess.share
                                    : 0.0;
        out.reflectingAfter +=
            gets || (guess.mirrors && guess.role == PaintRole::AsInFile) ? guess.share : 0.0;
    }
    std::stable_sort(out.paint.begin(), out.paint.end(),
                     [](const PaintProposal& a, const PaintProposal& b) {
                         return a.guess.share > b.guess.share;
                     });
    out.model.coat = paint + glass > 0.0;
    out.paintReason = fmt::format(
        "{:.0f} % of it would reflect as the file is; with clear coat on {:.0f} % (paint) and "
        "glass "
        "on {:.0f} % (windows), {:.0f} % does.",
        100.0 * out.reflectingBefore, 100.0 * paint, 100.0 * glass, 100.0 * out.reflectingAfter);
    for (const PaintProposal& p : out.paint) {
        if (p.guess.role == PaintRole::Dull && p.guess.share > kBaseShare) {
            out.concerns.push_back("Most of it is " + p.material +
                                   ": if that is something that the vehicle stands on, remove it "
                                   "in a modelling program.");
        }
    }
    if (out.reflectingAfter < 0.05)
        out.concerns.emplace_back("Hardly any of it would reflect: look at its materials.");
}

}  // namespace

const char* toString(VehicleKind kind) {
    return kind == VehicleKind::Tram ? "tram" : kind == VehicleKind::Bus ? "bus" : "car";
}

VehicleProposal proposeFit(const GltfModel& model) {
    VehicleProposal out;
    out.model.id = model.name;
    proposeUp(model, out);
    const glm::dmat3 upright = uprightFromFile(out.model.up);
    const Box box = uprightBox(model, upright);
    proposeSize(model, box.size(), out);
    proposeFront(model, upright, box, out);
    proposeGround(model, out);
    proposePaint(model, out);
    return out;
}

}  // namespace reflet
