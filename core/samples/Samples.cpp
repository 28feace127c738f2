// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/Samples.h"

#include "core/samples/paper/Paper.h"
#include "core/samples/square/Square.h"

namespace reflet {

std::vector<std::string> sampleNames() {
    return {"square", "paper"};
}

Result<Sample> makeSample(std::string_view name, std::uint64_t seed) {
    if (name == "square") {
        return square::makeSquare(seed);
    }
    if (name == "paper") {
        return paper::makePaper(seed);
    }
    return fail(ErrorCode::Usage, "there is no such sample city", std::string(name),
                "The samples are \"square\" and \"paper\".");
}

}  // namespace reflet
