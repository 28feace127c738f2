// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes must give a model that holds together, or an error with a text; as a library of
// materials, colours that are numbers.
#include "importers/obj/ObjFile.h"
#include "importers/obj/ObjImporter.h"
#include "tests/fuzz/CityChecks.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace reflet;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    ImportOptions options = fuzz::optionsFor(size);
    if (size % 3 == 1)
        options.upAxis = "y";
    fuzz::check(importObjBytes(bytes, "/nonexistent/fuzz.obj", options, {}));
    for (const obj::ObjMaterial& material : obj::readMaterials(bytes)) {
        const CityMaterial& look = material.look;
        fuzz::require(std::isfinite(look.diffuse.x + look.diffuse.y + look.diffuse.z +
                                    look.emission.x + look.shininess + look.transparency),
                      "colours are numbers");
    }
    return 0;
}
