// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/kit/Furniture.h"
#include "core/samples/kit/Ground.h"
#include "core/samples/kit/Tree.h"
#include "core/samples/square/SquarePlan.h"

#include <fmt/format.h>

#include <cmath>

namespace reflet::square {

namespace {

using namespace kit;

constexpr double kPath = kPavement;
constexpr double kLawn = kPavement + 0.06;
constexpr glm::dvec2 kPond{122.0, -15.0};

constexpr Plot kLawns[] = {
    {72, -11.5, 93, 7},   {97, -11.5, 116, 7},   {128, -11.5, 147, 7},   {151, -11.5, 172.5, 7},
    {72, -37, 93, -18.5}, {97, -37, 116, -18.5}, {128, -37, 147, -18.5}, {151, -37, 172.5, -18.5},
};

void lawn(Mesh& mesh, const Plot& plot) {
    constexpr int kStripes = 7;  // the mower's lanes
    const double w = plot.width() / kStripes;
    for (int i = 0; i < kStripes; ++i) {
        slab(mesh, {plot.x0 + i * w, plot.y0, plot.x0 + (i + 1) * w, plot.y1}, kLawn,
             {i % 2 == 0 ? Paint::Lawn : Paint::LawnMown, SurfaceType::Unknown});
    }
    const Skin edge{Paint::Granite, SurfaceType::Unknown};
    for (std::size_t s = 0; s < 4; ++s) {
        const std::array<glm::dvec2, 4> c{
            {{plot.x0, plot.y0}, {plot.x1, plot.y0}, {plot.x1, plot.y1}, {plot.x0, plot.y1}}};
        mesh.polygon(
            {{c[s], kPath}, {c[(s + 1) % 4], kPath}, {c[(s + 1) % 4], kLawn}, {c[s], kLawn}}, edge);
    }
}

void addGrounds(SampleCity& city, Random& random) {
    Mesh& paths = city.add("park-paths", CityObjectType::LandUse).mesh;
    constexpr int kColumns = 54;
    constexpr int kRows = 25;
    const double w = kPark.width() / kColumns, h = kPark.depth() / kRows;
    for (int j = 0; j < kRows; ++j) {
        for (int i = 0; i < kColumns; ++i) {
            slab(paths,
                 {kPark.x0 + i * w, kPark.y0 + j * h, kPark.x0 + (i + 1) * w,
                  kPark.y0 + (j + 1) * h},
                 kPath,
                 {random.chance(0.35) ? Paint::GravelDark : Paint::Gravel, SurfaceType::Unknown});
        }
    }
    for (std::size_t s = 0; s < 4; ++s) {
        const std::array<glm::dvec2, 4> c{{{kPark.x0, kPark.y0},
                                           {kPark.x1, kPark.y0},
                                           {kPark.x1, kPark.y1},
                                           {kPark.x0, kPark.y1}}};
        paths.polygon({{c[s], 0}, {c[(s + 1) % 4], 0}, {c[(s + 1) % 4], kPath}, {c[s], kPath}},
                      {Paint::Granite, SurfaceType::Unknown});
    }
    int number = 0;
    for (const Plot& plot : kLawns) {
        lawn(city.add(fmt::format("lawn-{}", ++number), CityObjectType::PlantCover).mesh, plot);
    }
}

void addPond(SampleCity& city) {
    const Skin stone{Paint::StonePale, SurfaceType::Unknown};
    Mesh& basin = city.add("park-fountain", CityObjectType::CityFurniture).mesh;
    const glm::dvec3 foot(kPond, kPath);
    lathe(basin, foot,
          {{4.6, 0},
           {4.6, 0.12},
           {4.3, 0.12},
           {4.25, 0.5},
           {4.4, 0.55},
           {4.4, 0.62},
           {3.95, 0.62},
           {3.95, 0.2}},
          32, stone);
    lathe(basin, foot,
          {{0.5, 0.2},
           {0.35, 1.2},
           {1.4, 1.5},
           {1.5, 1.62},
           {1.3, 1.58},
           {0.25, 1.4},
           {0.2, 2.2},
           {0.65, 2.35},
           {0.7, 2.45},
           {0.1, 2.4},
           {0.0, 2.9}},
          20, stone);
    disc(city.add("park-fountain-water", CityObjectType::WaterBody).mesh,
         foot + glm::dvec3(0, 0, 0.46), 3.95, 32, {Paint::Water, SurfaceType::Unknown});
}

struct Species {
    std::size_t plane, pine, palm, cypress, olive, linden;
};

void plant(SampleCity& city, std::size_t shape, const glm::dvec2& at, double z, Random& random,
           int& number) {
    SampleObject& object =
        city.add(fmt::format("park-tree-{:03}", ++number), CityObjectType::SolitaryVegetation);
    object.placements.push_back(
        {shape, glm::dvec3(at, z), random.between(0, 2 * kPi), random.between(0.88, 1.12)});
}

void addTrees(SampleCity& city, Random& random) {
    const Species s{city.addTemplate(planeTree(random)), city.addTemplate(stonePine(random)),
                    city.addTemplate(datePalm(random)),  city.addTemplate(cypress(random)),
                    city.addTemplate(oliveTree(random)), city.addTemplate(lindenTree(random))};
    int number = 0;
    // Palms line the promenade to the tram; planes shade the middle path; pines, olives and
    // cypresses stand on the lawns.
    for (double x = 75; x < 172; x += 12.0) {
        plant(city, s.palm, {x, 4.6}, kLawn, random, number);
    }
    for (const double x : {76.0, 86.5, 101.0, 112.0, 132.0, 143.0, 155.0, 167.0}) {
        plant(city, s.plane, {x, -9.6 + random.between(-0.3, 0.3)}, kLawn, random, number);
        plant(city, s.plane, {x + 1.5, -20.6 + random.between(-0.3, 0.3)}, kLawn, random, number);
    }
    for (const double x : {82.0, 107.0, 138.0, 161.0}) {
        plant(city, s.pine, {x, -1.5}, kLawn, random, number);
        plant(city, s.olive, {x - 7.0, -29.5}, kLawn, random, number);
        plant(city, s.olive, {x + 5.0, -33.0}, kLawn, random, number);
        plant(city, s.pine, {x + 1.0, -28.0}, kLawn, random, number);
    }
    for (double x = 73.5; x < 174; x += 6.5) {
        plant(city, s.cypress, {x, -38.3}, kPath, random, number);
    }
    for (const double y : {-33.0, -27.0, -21.0, -9.0, -3.0, 3.0}) {
        plant(city, s.linden, {174.4, y}, kPath, random, number);
    }
}

void placeRow(SampleObject& object, std::size_t shape, glm::dvec2 from, glm::dvec2 to, double step,
              double z, double heading) {
    const double length = glm::length(to - from);
    const int count = std::max(1, int(std::lround(length / step)));
    for (int i = 0; i < count; ++i) {
        const glm::dvec2 at = from + (to - from) * ((i + 0.5) / count);
        object.placements.push_back({shape, glm::dvec3(at, z), heading, 1.0});
    }
}

void addHedgesAndBeds(SampleCity& city, Random& random) {
    const std::size_t shape = city.addTemplate(hedge(random));
    SampleObject& hedges = city.add("park-hedges", CityObjectType::SolitaryVegetation);
    for (const auto& [a, b] :
         {std::pair{70.0, 94.0}, {98.0, 119.0}, {125.0, 146.0}, {150.0, 174.0}}) {
        placeRow(hedges, shape, {a, 8.9}, {b, 8.9}, 2.0, kPath, 0.0);
    }
    for (const auto& [a, b] : {std::pair{-36.0, -18.0}, {-12.0, 8.0}}) {
        placeRow(hedges, shape, {69.4, a}, {69.4, b}, 2.0, kPath, 0.5 * kPi);
    }
    const std::size_t beds[] = {city.addTemplate(flowerBed(Paint::FlowerRed, random)),
                                city.addTemplate(flowerBed(Paint::FlowerYellow, random)),
                                city.addTemplate(flowerBed(Paint::FlowerViolet, random))};
    SampleObject& flowers = city.add("park-flowers", CityObjectType::SolitaryVegetation);
    int kind = 0;
    for (const double x : {74.5, 90.5, 99.5, 113.5, 130.5, 144.5, 153.5, 169.5}) {
        for (const double y : {-13.0, -17.0}) {
            flowers.placements.push_back({beds[kind++ % 3], {x, y, kPath}, 0.0, 0.8});
        }
    }
}

void addBenches(SampleCity& city) {
    const std::size_t shape = city.addTemplate(bench());
    const std::size_t lamp = city.addTemplate(streetLamp());
    SampleObject& benches = city.add("park-benches", CityObjectType::CityFurniture);
    for (const double x : {79.0, 85.0, 103.0, 109.0, 134.0, 140.0, 157.0, 163.0}) {
        benches.placements.push_back({shape, {x, -12.3, kPath}, -0.5 * kPi, 1.0});
        benches.placements.push_back({shape, {x + 2.0, -17.7, kPath}, 0.5 * kPi, 1.0});
        benches.placements.push_back({shape, {x + 1.0, 11.2, kPavement}, 0.5 * kPi, 1.0});
    }
    SampleObject& lamps = city.add("park-lamps", CityObjectType::CityFurniture);
    for (const double x : {71.0, 95.0, 118.0, 126.0, 149.0, 174.0}) {
        for (const double y : {-12.0, -18.0, 8.0}) {
            lamps.placements.push_back({lamp, {x, y, kPath}, 0.0, 0.9});
        }
    }
}

}  // namespace

void addPark(SampleCity& city, Random random) {
    addGrounds(city, random);
    addPond(city);
    addTrees(city, random);
    addHedgesAndBeds(city, random);
    addBenches(city);
}

}  // namespace reflet::square
