// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/Frame.h"
#include "core/project/Project.h"
#include "core/project/ProjectItem.h"

#include <QWidget>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace reflet {

/// What is known about a city model's file.
enum class FileMark { Fine, Missing, Changed };

/// All that is in the project, by kind, with a filter above. Emits what the user asks for and
/// changes nothing itself. Updates rows in place, so that hundreds of probes stay quick and the
/// selection stays.
class ProjectTree : public QWidget {
    Q_OBJECT

public:
    explicit ProjectTree(QWidget* parent = nullptr);
    ~ProjectTree() override;

    void setProject(const Project& project);
    void setProbeStates(std::map<std::string, ProbeState> states);
    /// By path; files that are not named are fine.
    void setModelMarks(std::map<std::string, FileMark> marks);
    /// Without a signal.
    void setSelection(const std::vector<ProjectItem>& items);
    [[nodiscard]] std::vector<ProjectItem> selection() const;

Q_SIGNALS:
    void selectionChanged(std::vector<reflet::ProjectItem> items);
    void renamed(reflet::ProjectItem item, QString name);
    void removeRequested(std::vector<reflet::ProjectItem> items);
    void duplicateRequested(std::vector<reflet::ProjectItem> items);
    void frameRequested(reflet::ProjectItem item);
    void contextMenuAt(QPoint global, std::vector<reflet::ProjectItem> items);

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

}  // namespace reflet
