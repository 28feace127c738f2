// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/kit/Church.h"
#include "core/samples/kit/House.h"
#include "core/samples/square/SquarePlan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace reflet::square {

namespace {

using namespace kit;

/// The uniform order of the square's palaces: arcades, a noble floor with pediments, two more.
HouseStyle palaceStyle(Paint wall, bool alongX) {
    HouseStyle style;
    style.wall = wall;
    style.grand = true;
    style.detail = Detail::High;
    style.dormers = true;
    style.bay = 4.0;
    style.groundHeight = style.arcade.height;
    style.storeys = {4.5, 3.9, 3.1};
    style.roof.alongX = alongX;
    style.roof.pitch = 0.42;
    style.roof.gable = wall;
    if (wall == Paint::PlasterOchre) {
        style.shutter = Paint::ShutterBlue;
        style.shutterDark = Paint::ShutterBlueDark;
    }
    return style;
}

void addPalaces(SampleCity& city, Random& random) {
    constexpr Treatment kArcade = Treatment::Arcade, kShops = Treatment::Shops;
    constexpr Treatment kParty = Treatment::Party, kRear = Treatment::Rear;
    struct Palace {
        const char* id;
        Plot plot;
        Paint wall;
        Sides sides;
    };
    // South, east, north, west.
    const Palace palaces[] = {
        {"palace-north", {-60, 34, 8, 50}, Paint::PlasterRed, {kArcade, kShops, kRear, kParty}},
        {"palace-north-east",
         {22, 34, 62, 50},
         Paint::PlasterRed,
         {kArcade, kShops, kRear, kShops}},
        {"palace-west", {-76, 21, -60, 34}, Paint::PlasterRed, {kShops, kArcade, kParty, kParty}},
        {"palace-south",
         {-60, -56, -8, -42},
         Paint::PlasterOchre,
         {kRear, kShops, kArcade, kParty}},
        {"palace-south-east",
         {8, -56, 60, -42},
         Paint::PlasterOchre,
         {kRear, kShops, kArcade, kShops}},
    };
    for (const Palace& p : palaces) {
        HouseStyle style = palaceStyle(p.wall, p.plot.width() >= p.plot.depth());
        Mesh& mesh = city.add(p.id, CityObjectType::Building).mesh;
        house(mesh, p.plot, kPavement, style, p.sides, random);
    }
}

void addChurch(SampleCity& city, Random& random) {
    Mesh& front = city.add("church", CityObjectType::Building).mesh;
    const Facade facade{{-61.0, -41.0, kPavement}, {0, 1}, 22.0};
    church(front, facade, 46.0, random);
    Mesh& tower = city.add("clock-tower", CityObjectType::Building).mesh;
    clockTower(tower, {-68.2, -17.6, -60.6, -10.0}, kPavement, random);
}

HouseStyle streetStyle(Random& random) {
    static constexpr std::array kWalls{
        Paint::PlasterCream, Paint::PlasterYellow, Paint::PlasterRose,
        Paint::PlasterOchre, Paint::PlasterTerra,  Paint::PlasterWhite,
        Paint::PlasterSage,  Paint::PlasterRed,    Paint::PlasterYellow};
    static constexpr std::array kShutters{Paint::ShutterGreen, Paint::ShutterBlue,
                                          Paint::ShutterGrey, Paint::ShutterGreen};
    HouseStyle style;
    style.wall = random.pick(kWalls);
    style.shutter = random.pick(kShutters);
    style.shutterDark = Paint(int(style.shutter) + 1);
    style.trim = random.chance(0.7) ? Paint::Trim : Paint::StonePale;
    style.groundHeight = random.between(4.2, 4.8);
    const int storeys = random.integer(3, 4);
    style.storeys.clear();
    for (int i = 0; i < storeys; ++i) {
        style.storeys.push_back(random.between(3.2, 3.6) - 0.1 * i);
    }
    style.bay = random.between(3.0, 3.5);
    style.roof.pitch = random.between(0.38, 0.5);
    style.roof.course = 0.9;
    style.roof.patch = 6.0;
    style.roof.gable = style.wall;
    style.dormers = random.chance(0.25);
    return style;
}

/// A row of town houses along a street: `from` to `to` along its front, which faces `facing`.
struct Row {
    const char* id;
    Side facing;
    double front;  ///< coordinate of the front
    double from, to;
    double depth;
    bool openFrom, openTo;  ///< the row's ends stand on side streets
    Detail detail;
};

Plot plotOf(const Row& row, double a, double b) {
    switch (row.facing) {
        case Side::South:
            return {a, row.front, b, row.front + row.depth};
        case Side::North:
            return {a, row.front - row.depth, b, row.front};
        case Side::East:
            return {row.front - row.depth, a, row.front, b};
        case Side::West:
            break;
    }
    return {row.front, a, row.front + row.depth, b};
}

void addRow(SampleCity& city, const Row& row, Random& random) {
    const bool alongX = row.facing == Side::South || row.facing == Side::North;
    const int count = std::max(1, int(std::lround((row.to - row.from) / 17.0)));
    std::vector<double> cuts{row.from};
    for (int i = 1; i < count; ++i) {
        const double even = row.from + (row.to - row.from) * i / count;
        cuts.push_back(even + random.between(-2.5, 2.5));
    }
    cuts.push_back(row.to);
    Paint last = Paint::None;
    for (int i = 0; i < count; ++i) {
        HouseStyle style = streetStyle(random);
        while (style.wall == last) {
            style = streetStyle(random);
        }
        last = style.wall;
        const bool openLow = i == 0 && row.openFrom, openHigh = i + 1 == count && row.openTo;
        style.roof.alongX = alongX;
        style.detail = row.detail;
        style.roof.hipStart = openLow;
        style.roof.hipEnd = openHigh;
        Sides sides{Treatment::Party, Treatment::Party, Treatment::Party, Treatment::Party};
        sides[std::size_t(row.facing)] = Treatment::Shops;
        sides[(std::size_t(row.facing) + 2) % 4] = Treatment::Rear;
        const std::size_t low = alongX ? std::size_t(Side::West) : std::size_t(Side::South);
        const std::size_t high = alongX ? std::size_t(Side::East) : std::size_t(Side::North);
        sides[low] = openLow ? Treatment::Plain : Treatment::Party;
        sides[high] = openHigh ? Treatment::Plain : Treatment::Party;
        Mesh& mesh =
            city.add(fmt::format("house-{}-{:02}", row.id, i + 1), CityObjectType::Building).mesh;
        house(mesh, plotOf(row, cuts[std::size_t(i)], cuts[std::size_t(i) + 1]), kPavement, style,
              sides, random);
    }
}

constexpr Row kRows[] = {
    {"avenue-north-3", Side::South, 21, -148, -76, 13, true, false, Detail::Middle},
    {"avenue-north-2", Side::South, 21, -250, -160, 13, true, true, Detail::Middle},
    {"avenue-north-1", Side::South, 21, -340, -262, 13, true, true, Detail::Low},
    {"avenue-south-3", Side::North, -9, -148, -69, 11.5, true, false, Detail::Middle},
    {"avenue-south-2", Side::North, -9, -250, -160, 13, true, true, Detail::Middle},
    {"avenue-south-1", Side::North, -9, -340, -262, 13, true, true, Detail::Low},
    {"park-north", Side::South, 34, 76, 202, 13, true, true, Detail::Middle},
    {"park-south", Side::North, -58, 74, 176, 13, true, true, Detail::Low},
    {"park-east-1", Side::West, 214, -108, -58, 13, true, false, Detail::Low},
    {"park-east-2", Side::West, 214, -58, 44, 13, false, false, Detail::Middle},
    {"park-east-3", Side::West, 214, 44, 93, 13, false, true, Detail::Low},
    {"north-street-west", Side::East, 8, 50, 93, 12, false, true, Detail::Low},
    {"north-street-east", Side::West, 22, 50, 93, 12, false, true, Detail::Low},
    {"south-street-west", Side::East, -8, -93, -56, 12, true, false, Detail::Low},
    {"south-street-east", Side::West, 8, -93, -56, 12, true, false, Detail::Low},
};

}  // namespace

void addTown(SampleCity& city, Random random) {
    Random palaces = random.fork(1), churches = random.fork(2), rows = random.fork(3);
    addPalaces(city, palaces);
    addChurch(city, churches);
    for (const Row& row : kRows) {
        addRow(city, row, rows);
    }
}

}  // namespace reflet::square
