// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

class QWidget;

namespace reflet {

class Commands;

/// All keys at a glance, over the window.
void showKeys(const Commands& commands, QWidget* window);

/// What the picture shows and where reflections come from, in plain words.
void showExplanation(QWidget* window);

/// Version, licence, and the libraries with theirs.
void showAbout(QWidget* window);

}  // namespace reflet
