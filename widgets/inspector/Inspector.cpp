// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/inspector/Inspector.h"

namespace reflet {
struct Inspector::Impl {};
Inspector::Inspector(QWidget* parent) : QWidget(parent), m_impl(std::make_unique<Impl>()) {}
Inspector::~Inspector() = default;
void Inspector::setProject(const Project&, const QString&) {}
void Inspector::setSelection(const std::vector<ProjectItem>&) {}
void Inspector::setProbeFacts(std::map<std::string, ProbeFacts>) {}
void Inspector::setModelFacts(std::map<std::string, ModelFacts>) {}
void Inspector::setReflectorFigures(std::map<std::string, QString>) {}
}  // namespace reflet
