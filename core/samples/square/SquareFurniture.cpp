// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/kit/Furniture.h"
#include "core/samples/kit/Ground.h"
#include "core/samples/kit/Tree.h"
#include "core/samples/square/SquarePlan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace reflet::square {

namespace {

using namespace kit;

constexpr glm::dvec2 kFountain{4.0, -13.0};
/// Where the views stand, and a little before them.
constexpr glm::dvec2 kCameras[] = {{50.0, 30.0}, {-92.0, 18.0}, {122.0, 12.5}, {108.0, 12.5}};

void set(SampleObject& object, std::size_t shape, glm::dvec2 at, double z, double heading = 0.0,
         double scale = 1.0) {
    object.placements.push_back({shape, glm::dvec3(at, z), heading, scale});
}

/// A basin with a column that carries a bronze sphere in rings, water falling from two bowls.
void addFountain(SampleCity& city) {
    const Skin stone{Paint::StonePale, SurfaceType::Unknown};
    const Skin bronze{Paint::Bronze, SurfaceType::Unknown};
    const Skin foam{Paint::WaterFoam, SurfaceType::Unknown};
    Mesh& mesh = city.add("fountain", CityObjectType::CityFurniture).mesh;
    const glm::dvec3 foot(kFountain, kPaving);
    lathe(mesh, foot,
          {{8.6, 0},
           {8.6, 0.15},
           {8.1, 0.15},
           {8.1, 0.3},
           {7.6, 0.3},
           {7.5, 0.8},
           {7.7, 0.85},
           {7.7, 0.95},
           {7.0, 0.95},
           {7.0, 0.4}},
          40, stone);
    lathe(mesh, foot,
          {{1.9, 0.4},
           {1.7, 1.0},
           {0.9, 1.2},
           {0.7, 2.3},
           {2.7, 2.9},
           {2.8, 3.05},
           {2.5, 3.0},
           {0.6, 2.7},
           {0.45, 4.2},
           {1.4, 4.6},
           {1.45, 4.72},
           {1.2, 4.68},
           {0.4, 4.5},
           {0.3, 5.6},
           {0.55, 5.75},
           {0.5, 5.95}},
          28, stone);
    std::vector<glm::dvec2> ball;
    for (int i = 0; i <= 10; ++i) {
        const double a = kPi * (i / 10.0 - 0.5);
        ball.emplace_back(0.62 * std::cos(a), 6.55 + 0.62 * std::sin(a));
    }
    lathe(mesh, foot, ball, 20, bronze);
    for (const double tilt : {0.35, -0.5}) {  // armillary rings
        for (int i = 0; i < 32; ++i) {
            const auto at = [&](int k) {
                const double a = 2 * kPi * k / 32;
                return foot + glm::dvec3(1.0 * std::cos(a), 1.0 * std::sin(a) * std::cos(tilt),
                                         6.55 + 1.0 * std::sin(a) * std::sin(tilt) * 2.0);
            };
            bar(mesh, at(i), at(i + 1), 0.045, 0.045, 4, {Paint::Gold, SurfaceType::Unknown});
        }
    }
    for (int i = 0; i < 24; ++i) {  // threads of water from the rims of both bowls
        const double a = 2 * kPi * (i + 0.5) / 24;
        const glm::dvec3 d(std::cos(a), std::sin(a), 0);
        bar(mesh, foot + 2.78 * d + glm::dvec3(0, 0, 3.0), foot + 3.1 * d + glm::dvec3(0, 0, 0.75),
            0.025, 0.05, 4, foam);
        if (i % 2 == 0) {
            bar(mesh, foot + 1.43 * d + glm::dvec3(0, 0, 4.68),
                foot + 1.7 * d + glm::dvec3(0, 0, 3.0), 0.02, 0.035, 4, foam);
        }
    }
    disc(city.add("fountain-water", CityObjectType::WaterBody).mesh, foot + glm::dvec3(0, 0, 0.75),
         7.0, 40, {Paint::Water, SurfaceType::Unknown});
}

void addLamps(SampleCity& city) {
    const std::size_t candelabra = city.addTemplate(lampPost());
    const std::size_t mast = city.addTemplate(lightMast());
    SampleObject& lamps = city.add("square-lamps", CityObjectType::CityFurniture);
    for (const double x : {-48.0, -32.0, -16.0, 0.0, 28.0, 44.0, 60.0}) {
        set(lamps, candelabra, {x, 31.2}, kPavement + 0.02);
    }
    for (const double x : {-48.0, -32.0, -16.0, 14.0, 30.0, 46.0}) {
        set(lamps, candelabra, {x, -36.9}, kPavement + 0.02);
    }
    for (const double x : {-66.0, -98.0, -130.0, -170.0, -202.0, -234.0}) {
        set(lamps, candelabra, {x, 16.4}, kPavement + 0.02);
        set(lamps, candelabra, {x, -4.4}, kPavement + 0.02);
    }
    for (double x = 82.0; x < 200.0; x += 22.0) {
        set(lamps, candelabra, {x, 30.9}, kPavement + 0.02);
    }
    // Masts follow the tram across the square, on its southern side.
    SampleObject& masts = city.add("square-masts", CityObjectType::CityFurniture);
    const std::vector<glm::dvec2> axis = tramAxis();
    for (const glm::dvec2& at : stationsAlong(axis, 376.0 - 52.0, 21.0)) {
        if (at.x < 60.0) {
            set(masts, mast, at + glm::dvec2(0.0, -5.2), kPaving);
        }
    }
}

void addTerrace(SampleCity& city, Random& random) {
    const std::size_t cream = city.addTemplate(parasol(Paint::Parasol));
    const std::size_t red = city.addTemplate(parasol(Paint::ParasolRed));
    const std::size_t tables[] = {city.addTemplate(cafeTable(random)),
                                  city.addTemplate(cafeTable(random)),
                                  city.addTemplate(cafeTable(random))};
    SampleObject& terrace = city.add("cafe-terraces", CityObjectType::CityFurniture);
    const auto field = [&](const Plot& plot, std::size_t shade) {
        for (double y = plot.y0; y <= plot.y1; y += 3.2) {
            for (double x = plot.x0; x <= plot.x1; x += 3.4) {
                const glm::dvec2 at(x + random.between(-0.3, 0.3), y + random.between(-0.3, 0.3));
                set(terrace, tables[random.integer(0, 2)], at, kPaving, random.between(0, 2 * kPi));
                if (random.chance(0.75)) {
                    set(terrace, shade, at + glm::dvec2(0.55, 0.35), kPaving, random.between(0, 1));
                }
            }
        }
    };
    field({-44, -33.5, -28, -29.5}, red);
    field({16, -33.5, 34, -29.5}, cream);
    field({-46, 24.0, -34, 27.5}, cream);
    field({-8, 26.4, 3, 28.4}, red);
}

void addGreenery(SampleCity& city, Random& random) {
    const std::size_t orange = city.addTemplate(orangeTree(random));
    const std::size_t palm = city.addTemplate(datePalm(random));
    const std::size_t tub = city.addTemplate(planter());
    const std::size_t beds = city.addTemplate(flowerBed(Paint::FlowerRed, random));
    SampleObject& tubs = city.add("square-planters", CityObjectType::CityFurniture);
    int number = 0;
    const auto tree = [&](std::size_t shape, glm::dvec2 at, double z, double scale) {
        SampleObject& object = city.add(fmt::format("street-tree-{:03}", ++number),
                                        CityObjectType::SolitaryVegetation);
        set(object, shape, at, z, random.between(0, 2 * kPi), scale * random.between(0.92, 1.08));
    };
    std::vector<glm::dvec2> tubPlaces;
    for (const double x : {-50.0, -25.0, -21.0, 12.0, 38.0, 50.0}) {
        tubPlaces.emplace_back(x, -34.6);
    }
    for (const double y : {-30.0, -22.0, -10.0, -2.0}) {
        tubPlaces.emplace_back(57.5, y);
    }
    for (const glm::dvec2& at : tubPlaces) {
        set(tubs, tub, at, kPaving);
    }
    for (const glm::dvec2& at : tubPlaces) {
        tree(orange, at, kPaving + 0.7, 0.85);
    }
    for (const glm::dvec2& at : {glm::dvec2{-14, -22}, {22, -22}, {-14, -4}, {22, -4}}) {
        tree(palm, at, kPaving, 1.0);
        city.add(fmt::format("palm-bed-{}", ++number), CityObjectType::SolitaryVegetation)
            .placements.push_back({beds, glm::dvec3(at, kPaving), 0.0, 1.4});
    }
    for (double x = -244.0; x < -62.0; x += 12.0) {  // orange trees along the avenue
        if (std::abs(x + 154.0) > 9.0 && std::abs(x + 80.0) > 4.5) {
            tree(orange, {x, 17.3}, kPavement, 1.25);
            tree(orange, {x + 1.0, -5.4}, kPavement, 1.25);
        }
    }
}

void addSmallThings(SampleCity& city) {
    const std::size_t post = city.addTemplate(bollard());
    const std::size_t seat = city.addTemplate(bench());
    const std::size_t bin = city.addTemplate(litterBin());
    SampleObject& bollards = city.add("bollards", CityObjectType::CityFurniture);
    for (double x = -54.0; x <= 8.0; x += 3.1) {
        set(bollards, post, {x, 29.5}, kPaving);
    }
    for (double y = -34.0; y <= 13.0; y += 3.1) {
        set(bollards, post, {61.4, y}, kPaving);
    }
    for (double x = 77.0; x <= 160.0; x += 4.0) {
        set(bollards, post, {x, 15.7}, kPavement);
    }
    SampleObject& benches = city.add("square-benches", CityObjectType::CityFurniture);
    for (int i = 0; i < 8; ++i) {  // in a ring about the fountain
        const double a = 2 * kPi * (i + 0.5) / 8;
        set(benches, seat, kFountain + 12.0 * glm::dvec2(std::cos(a), std::sin(a)), kPaving,
            a + kPi);
    }
    SampleObject& bins = city.add("litter-bins", CityObjectType::CityFurniture);
    for (const glm::dvec2& at :
         {glm::dvec2{-20, 30.8}, {40, 30.8}, {-52, -10}, {58, -16}, {-8, -35.2}, {9, -35.2}}) {
        set(bins, bin, at, at.y > 30.0 ? kPavement + 0.02 : kPaving);
    }
    set(city.add("kiosk", CityObjectType::CityFurniture), city.addTemplate(kiosk()), {46.0, -20.0},
        kPaving, 0.3);
    const std::size_t shelter = city.addTemplate(tramShelter());
    SampleObject& stop = city.add("tram-stop", CityObjectType::CityFurniture);
    set(stop, shelter, {142.0, 14.4}, kPavement, kPi);
    set(stop, shelter, {152.0, 14.4}, kPavement, kPi);
    set(stop, shelter, {-110.0, -4.9}, kPavement, kPi, 0.9);
}

void addParkedCars(SampleCity& city, Random& random) {
    const std::size_t cars[] = {city.addTemplate(parkedCar(Paint::SignBlue)),
                                city.addTemplate(parkedCar(Paint::FrameWhite)),
                                city.addTemplate(parkedCar(Paint::AwningRed)),
                                city.addTemplate(parkedCar(Paint::Steel)),
                                city.addTemplate(parkedCar(Paint::SignDark)),
                                city.addTemplate(parkedCar(Paint::ShutterBlueDark)),
                                city.addTemplate(parkedCar(Paint::PlasterSage))};
    SampleObject& parked = city.add("parked-cars", CityObjectType::CityFurniture);
    const auto row = [&](glm::dvec2 from, glm::dvec2 to, double share) {
        const double length = glm::length(to - from);
        const glm::dvec2 d = (to - from) / length;
        for (double s = 2.5; s + 2.5 < length; s += 5.4) {
            if (random.chance(share)) {
                const glm::dvec2 at = from + (s + random.between(-0.4, 0.4)) * d;
                set(parked, cars[random.integer(0, 6)], at, 0.0, std::atan2(d.y, d.x));
            }
        }
    };
    row({-164, 14.4}, {-250, 14.4}, 0.75);
    row({-86, 14.4}, {-144, 14.4}, 0.75);
    row({-250, -2.5}, {-164, -2.5}, 0.75);
    row({-144, -2.5}, {-86, -2.5}, 0.75);
    row({200, 28.9}, {156, 28.9}, 0.7);
    row({148, 28.9}, {92, 28.9}, 0.7);
    row({207.8, -50}, {207.8, 24}, 0.7);
    row({11.6, 92}, {11.6, 64}, 0.8);
    row({-4.4, -62}, {-4.4, -92}, 0.8);
}

void addPeople(SampleCity& city, Random& random) {
    const std::size_t people[] = {
        city.addTemplate(passerBy(Paint::SignBlue, Paint::SignDark, Paint::DoorWood)),
        city.addTemplate(passerBy(Paint::AwningCream, Paint::ShutterBlueDark, Paint::SignDark)),
        city.addTemplate(passerBy(Paint::SignRed, Paint::StoneDark, Paint::FrameWood)),
        city.addTemplate(passerBy(Paint::ShutterGreenDark, Paint::SignDark, Paint::StonePale)),
        city.addTemplate(passerBy(Paint::FlowerYellow, Paint::AwningBlue, Paint::DoorWood)),
    };
    SampleObject& crowd = city.add("passers-by", CityObjectType::CityFurniture);
    struct Field {
        Plot plot;
        int count;
        double z;
    };
    const Field fields[] = {
        {{-50, 30.5, 60, 33.2}, 14, kPavement + 0.02},
        {{-50, 34.8, 60, 37.0}, 9, kPavement + 0.02},
        {{-50, -28, -12, -2}, 10, kPaving},
        {{18, -28, 54, 4}, 11, kPaving},
        {{-50, -41, 55, -37.5}, 10, kPavement + 0.02},
        {{-140, 18.6, -66, 20.4}, 10, kPavement + 0.02},
        {{-140, -8.3, -72, -6.6}, 8, kPavement + 0.02},
        {{76, 11.8, 158, 13.2}, 9, kPavement},
        {{74, -16.5, 112, -13.5}, 8, kPavement},
        {{-236, 18.6, -164, 20.4}, 6, kPavement + 0.02},
    };
    for (const Field& f : fields) {
        for (int i = 0; i < f.count; ++i) {
            const glm::dvec2 at(random.between(f.plot.x0, f.plot.x1),
                                random.between(f.plot.y0, f.plot.y1));
            // No one stands on the street that leads north, nor right before a view's camera.
            const bool onStreet = at.x > 8.0 && at.x < 22.0 && at.y > 30.0;
            const bool beforeCamera = std::any_of(
                std::begin(kCameras), std::end(kCameras),
                [&](const glm::dvec2& camera) { return glm::length(at - camera) < 10.0; });
            if (onStreet || beforeCamera) {
                continue;
            }
            const double heading = random.between(0, 2 * kPi);
            set(crowd, people[random.integer(0, 4)], at, f.z, heading, random.between(0.93, 1.05));
            if (random.chance(0.35)) {  // in company
                const glm::dvec2 beside =
                    at + 0.6 * glm::dvec2(-std::sin(heading), std::cos(heading));
                set(crowd, people[random.integer(0, 4)], beside, f.z, heading + 0.2,
                    random.between(0.9, 1.05));
            }
        }
    }
}

}  // namespace

void addFurniture(SampleCity& city, Random random) {
    addFountain(city);
    addLamps(city);
    addTerrace(city, random);
    addGreenery(city, random);
    addSmallThings(city);
    addParkedCars(city, random);
    addPeople(city, random);
}

}  // namespace reflet::square
