// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/ProjectTree.h"

namespace reflet {
struct ProjectTree::Impl {
    std::vector<ProjectItem> selection;
};
ProjectTree::ProjectTree(QWidget* parent) : QWidget(parent), m_impl(std::make_unique<Impl>()) {}
ProjectTree::~ProjectTree() = default;
void ProjectTree::setProject(const Project&) {}
void ProjectTree::setProbeStates(std::map<std::string, ProbeState>) {}
void ProjectTree::setModelMarks(std::map<std::string, FileMark>) {}
void ProjectTree::setSelection(const std::vector<ProjectItem>& items) {
    m_impl->selection = items;
}
std::vector<ProjectItem> ProjectTree::selection() const {
    return m_impl->selection;
}
}  // namespace reflet
