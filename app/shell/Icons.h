// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QIcon>
#include <QString>

namespace reflet {

/// An icon of resources/icons, drawn in the text colour of the present palette at any size: it
/// follows a change between light and dark by itself. A name that does not exist draws nothing.
[[nodiscard]] QIcon icon(const QString& name);

/// The program's own icon, in its own colours.
[[nodiscard]] QIcon programIcon();

}  // namespace reflet
