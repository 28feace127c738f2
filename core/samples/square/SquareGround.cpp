// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/kit/Ground.h"
#include "core/samples/square/SquarePlan.h"

#include <algorithm>
#include <cmath>

namespace reflet::square {

namespace {

using namespace kit;

/// Asphalt under everything, level, in sheets of two tones.
void addStreets(SampleCity& city, Random& random) {
    Mesh& mesh = city.add("streets", CityObjectType::Road).mesh;
    constexpr int kColumns = 35;
    constexpr int kRows = 26;
    const double w = kTown.width() / kColumns, h = kTown.depth() / kRows;
    for (int j = 0; j < kRows; ++j) {
        for (int i = 0; i < kColumns; ++i) {
            const Plot sheet{kTown.x0 + i * w, kTown.y0 + j * h, kTown.x0 + (i + 1) * w,
                             kTown.y0 + (j + 1) * h};
            slab(mesh, sheet, 0.0,
                 {random.chance(0.3) ? Paint::AsphaltWorn : Paint::Asphalt,
                  SurfaceType::TrafficArea});
        }
    }
    zebra(mesh, {-82, 9.6, -78, 15.3}, 0.02, true);
    zebra(mesh, {-82, -3.3, -78, 2.4}, 0.02, true);
    zebra(mesh, {84, 23.6, 88, 29.8}, 0.02, true);
    zebra(mesh, {150, 23.6, 154, 29.8}, 0.02, true);
    zebra(mesh, {193.6, -40, 208.8, -36}, 0.02, false);
    zebra(mesh, {10.7, 58, 19.3, 61}, 0.02, false);
    zebra(mesh, {66.2, 36, 73.8, 39.5}, 0.02, false);
    dashes(mesh, {-338, 12.4}, {-60, 12.4}, 0.02);
    dashes(mesh, {-338, -0.4}, {-60, -0.4}, 0.02);
    dashes(mesh, {80, 26.7}, {162, 26.7}, 0.02);
    dashes(mesh, {201, -12}, {201, -200}, 0.02);
    dashes(mesh, {15, 62}, {15, 230}, 0.02);
    dashes(mesh, {0, -60}, {0, -230}, 0.02);
    dashes(mesh, {80, -47.5}, {176, -47.5}, 0.02);
}

struct PavementPlot {
    const char* id;
    Plot plot;
    double flag;  ///< metres; 0 far from where anybody walks
};

constexpr PavementPlot kPavements[] = {
    {"pavement-north", {-60, 30, 10.5, 95}, 0.0},
    {"pavement-north-east", {19.5, 30, 66, 95}, 0.0},
    {"pavement-park-north", {74, 30, 204, 95}, 0.0},
    {"pavement-west-north", {-148, 15.5, -60, 95}, 0.0},
    {"pavement-west-corner", {-60, 15.5, -56, 30}, 1.2},
    {"pavement-west-south", {-148, -95, -60, -3.5}, 0.0},
    {"pavement-church", {-60, -36, -56, -3.5}, 1.2},
    {"pavement-south", {-60, -95, -5.5, -36}, 0.0},
    {"pavement-south-east", {5.5, -95, 62, -36}, 0.0},
    {"pavement-avenue-north-1", {-342, 15.5, -260, 95}, 0.0},
    {"pavement-avenue-north-2", {-252, 15.5, -158, 95}, 0.0},
    {"pavement-avenue-south-1", {-342, -95, -260, -3.5}, 0.0},
    {"pavement-avenue-south-2", {-252, -95, -158, -3.5}, 0.0},
    {"pavement-park-south", {72, -110, 180, -53}, 0.0},
    {"pavement-east", {209, -110, 302, 95}, 0.0},
    {"promenade-park-north", {68, 10, 162, 16.2}, 1.2},
    {"promenade-park-east", {176, -58, 186.2, -8}, 1.2},
};

/// Flags before the fronts, where the big pavements have one tone: laid 2 cm higher.
constexpr Plot kFlagged[] = {
    {-59.6, 30.4, 10.1, 33.9}, {19.9, 30.4, 65.6, 33.9},  {74.4, 30.4, 203.6, 33.9},
    {-147, 15.9, -60.4, 20.9}, {-147, -8.9, -60.4, -3.9}, {-59.6, -41.9, -5.9, -36.4},
    {5.9, -41.9, 61.6, -36.4}, {-251, 15.9, -159, 20.9},  {-251, -8.9, -159, -3.9},
};

void flags(Mesh& mesh, const Plot& plot, Random& random) {
    static constexpr std::array kTones{Paint::PaveGreyA, Paint::PaveGreyB, Paint::PaveGreyC,
                                       Paint::PaveGreyB};
    const int columns = int(std::lround(plot.width() / 1.3)),
              rows = int(std::lround(plot.depth() / 0.7));
    const double w = plot.width() / columns, h = plot.depth() / rows;
    for (int j = 0; j < rows; ++j) {
        int i = 0;
        while (i < columns) {  // runs of one to three flags of one tone
            const int run = std::min(random.integer(1, 3), columns - i);
            slab(mesh,
                 {plot.x0 + i * w, plot.y0 + j * h, plot.x0 + (i + run) * w, plot.y0 + (j + 1) * h},
                 kPavement + 0.02, {random.pick(kTones), SurfaceType::AuxiliaryTrafficArea});
            i += run;
        }
    }
}

void addPavements(SampleCity& city, Random& random) {
    for (const PavementPlot& p : kPavements) {
        pavement(city.add(p.id, CityObjectType::Road).mesh, p.plot, 0.0, kPavement, p.flag, random);
    }
    Mesh& mesh = city.add("flagstones", CityObjectType::Road).mesh;
    for (const Plot& plot : kFlagged) {
        flags(mesh, plot, random);
    }
    // Where the tram turns round the park's corner.
    std::vector<glm::dvec2> arc;
    for (int i = 0; i <= 16; ++i) {
        const double a = 0.5 * kPi * i / 16;
        arc.emplace_back(162.0 + 24.2 * std::cos(a), -8.0 + 24.2 * std::sin(a));
    }
    Mesh& corner = city.add("promenade-park-corner", CityObjectType::Road).mesh;
    std::vector<glm::dvec3> ring;
    for (const glm::dvec2& p : arc) {
        ring.emplace_back(p, kPavement);
    }
    ring.emplace_back(162, 10, kPavement);
    ring.emplace_back(176, 10, kPavement);
    ring.emplace_back(176, -8, kPavement);
    corner.polygon(ring, {Paint::PaveWarm, SurfaceType::AuxiliaryTrafficArea});
    ribbonEdge(corner, arc, 0.0, 0.0, kPavement, false,
               {Paint::Granite, SurfaceType::AuxiliaryTrafficArea});
}

void arcadeFloor(Mesh& mesh, const Plot& plot) {
    checkerboard(mesh, plot, kPavement + 0.02, 1.1, Paint::PaveLight, Paint::PaveWarm,
                 SurfaceType::AuxiliaryTrafficArea);
}

void addPaving(SampleCity& city) {
    Mesh& mesh = city.add("square", CityObjectType::TransportSquare).mesh;
    // A frame of granite about the chequered field, and the lip where it meets the asphalt.
    const Plot field = kPavedSquare.grown(-1.0);
    const Skin frame{Paint::Granite, SurfaceType::TrafficArea};
    slab(mesh, {kPavedSquare.x0, kPavedSquare.y0, kPavedSquare.x1, field.y0}, kPaving, frame);
    slab(mesh, {kPavedSquare.x0, field.y1, kPavedSquare.x1, kPavedSquare.y1}, kPaving, frame);
    slab(mesh, {kPavedSquare.x0, field.y0, field.x0, field.y1}, kPaving, frame);
    slab(mesh, {field.x1, field.y0, kPavedSquare.x1, field.y1}, kPaving, frame);
    checkerboard(mesh, field, kPaving, 1.6, Paint::PaveLight, Paint::PaveDark,
                 SurfaceType::TrafficArea);
    for (std::size_t s = 0; s < 4; ++s) {
        const Plot& p = kPavedSquare;
        const std::array<glm::dvec2, 4> c{{{p.x0, p.y0}, {p.x1, p.y0}, {p.x1, p.y1}, {p.x0, p.y1}}};
        mesh.polygon({{c[s], 0}, {c[(s + 1) % 4], 0}, {c[(s + 1) % 4], kPaving}, {c[s], kPaving}},
                     frame);
    }
    Mesh& esplanade = city.add("esplanade", CityObjectType::TransportSquare).mesh;
    checkerboard(esplanade, {62, -40, 68, 16.4}, kPaving, 1.5, Paint::PaveWarm, Paint::PaveLight,
                 SurfaceType::TrafficArea);
    Mesh& floors = city.add("arcade-floors", CityObjectType::TransportSquare).mesh;
    arcadeFloor(floors, {-59.6, 34.0, 7.6, 38.3});
    arcadeFloor(floors, {22.4, 34.0, 61.6, 38.3});
    arcadeFloor(floors, {-59.6, -46.3, -8.4, -42.0});
    arcadeFloor(floors, {8.4, -46.3, 59.6, -42.0});
    arcadeFloor(floors, {-64.3, 21.4, -60.0, 33.6});
}

}  // namespace

void addGround(SampleCity& city, Random random) {
    addStreets(city, random);
    addPavements(city, random);
    addPaving(city);
    const TrackStyle style{0.0, kTrackBed, kRail, kTrackSpacing, 3.4};
    tramTracks(city.add("tram-tracks", CityObjectType::Railway).mesh, tramAxis(), style);
}

}  // namespace reflet::square
