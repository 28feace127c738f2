// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/Samples.h"

#include "core/samples/paper/Paper.h"
#include "core/samples/square/Square.h"
#include "core/samples/whale/Whale.h"

namespace reflet {

std::vector<std::string> sampleNames() {
    return {"square", "paper", "whale"};
}

Result<Sample> makeSample(std::string_view name, std::uint64_t seed) {
    if (name == "square") {
        return square::makeSquare(seed);
    }
    if (name == "paper") {
        return paper::makePaper(seed);
    }
    if (name == "whale") {
        return whale::makeWhaleCity(seed);
    }
    return fail(ErrorCode::Usage, "there is no such sample city", std::string(name),
                "The samples are \"square\", \"paper\" and \"whale\".");
}

}  // namespace reflet
