// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/square/Square.h"

#include "core/samples/square/SquarePlan.h"

namespace reflet::square {

kit::SampleCity makeCity(std::uint64_t seed) {
    kit::SampleCity city;
    city.title = "Reflet sample: a city square with arcades, a park and a tram line";
    kit::Random random(seed);
    addGround(city, random.fork(1));
    addTown(city, random.fork(2));
    addOuterTown(city, random.fork(3));
    addPark(city, random.fork(4));
    addFurniture(city, random.fork(5));
    addHills(city, random.fork(6));
    return city;
}

Sample makeSquare(std::uint64_t seed) {
    Sample sample;
    sample.modelFileName = "square.city.json";
    // RGF93 v1 / Lambert-93 with NGF-IGN69 heights.
    const kit::SamplePlace place{"https://www.opengis.net/def/crs/EPSG/0/5698",
                                 {kPlaceEast, kPlaceNorth, kPlaceHeight}};
    sample.modelJson = kit::writeCityJson(makeCity(seed), place);
    sample.project = makeProject(sample.modelFileName);
    return sample;
}

}  // namespace reflet::square
