// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Benches.h"
#include "app/cli/Commands.h"

namespace reflet::cli {

int run(const BenchArguments& arguments, const Console& console) {
    if (arguments.what == "heightfield")
        return runHeightfield(arguments, console);
    if (arguments.what == "trace")
        return runTrace(arguments, console);
    if (arguments.what == "suggest" && arguments.files.size() <= 1)
        return runSuggest(arguments, console);
    if (arguments.what == "table1" && !arguments.files.empty())
        return runTable1(arguments, console);
    if (arguments.files.size() != 1) {
        return console.failed(
            {ErrorCode::Usage, "bench " + arguments.what + " needs one file", "FILE",
             "Name a project (frames, memory, reconstruct, suggest) or a city model (import)."});
    }
    if (arguments.what == "memory")
        return runMemory(arguments, console);
    if (arguments.what == "bake")
        return runBake(arguments, console);
    if (arguments.what == "reconstruct")
        return runReconstruct(arguments, console);
    return arguments.what == "import" ? runImport(arguments, console)
                                      : runFrames(arguments, console);
}

}  // namespace reflet::cli
