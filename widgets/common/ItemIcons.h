// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/project/ProjectItem.h"

#include <QIcon>

namespace reflet {

/// A small sign for a kind of thing, legible on light and dark grounds.
[[nodiscard]] QIcon itemIcon(ProjectItem::Kind kind);

}  // namespace reflet
