// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Commands.h"
#include "app/pipeline/PaperFigures.h"
#include "core/base/Files.h"

namespace reflet::cli {

int run(const FiguresArguments& arguments, const Console& console) {
    if (auto made = makeFolder(arguments.output); !made)
        return console.failed(made.error());
    auto city = PreparedCity::open(arguments.project, console.job());
    if (!city)
        return console.failed(city.error());
    const auto figures = drawPaperFigures(*city, arguments.output, console.job());
    if (!figures)
        return console.failed(figures.error());
    nlohmann::json pictures = nlohmann::json::array();
    for (const auto& picture : figures->pictures)
        pictures.push_back(picture.string());
    if (console.json())
        console.data({{"pictures", pictures}, {"remarks", toJson(figures->remarks)}});
    for (const auto& remark : figures->remarks)
        console.note(remark);
    for (const auto& picture : figures->pictures)
        console.text(picture.string());
    return kDone;
}

}  // namespace reflet::cli
