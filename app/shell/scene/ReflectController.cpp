// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/scene/ReflectController.h"

#include "app/document/LiveCity.h"
#include "app/document/ProjectDocument.h"
#include "app/shell/Commands.h"
#include "app/shell/Notices.h"
#include "widgets/viewport/Viewport.h"

namespace reflet {

ReflectController::ReflectController(Workbench& bench, QObject* parent)
    : QObject(parent), m_bench(bench) {
    auto on = [this](Command command, auto slot) {
        connect(m_bench.commands->action(command), &QAction::triggered, this, slot);
    };
    LiveCity* live = bench.live;
    on(Command::BakeNow, [live] { live->bakeNow(); });
    on(Command::CancelBaking, [live] { live->cancelBaking(); });
    on(Command::AutoBake, [live](bool automatic) { live->setAutoBake(automatic); });
    bench.commands->action(Command::AutoBake)->setChecked(true);
    live->setAutoBake(true);
}

void ReflectController::makeItReflect() {}

}  // namespace reflet
