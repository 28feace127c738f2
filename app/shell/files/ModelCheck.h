// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/shell/Workbench.h"
#include "widgets/panels/ProjectTree.h"

#include <QObject>
#include <map>
#include <set>
#include <string>

namespace reflet {

/// Looks whether the city models of a project are where it says and as they were when they were
/// imported; for those that are not, offers to find them or to use them as they are.
class ModelCheck : public QObject {
    Q_OBJECT
public:
    ModelCheck(Workbench& bench, QObject* parent);

    void check();
    /// Asks for the file that a model has become, and puts it in the model's place.
    void locate(const std::string& path);

private:
    struct Finding {
        FileMark mark = FileMark::Fine;
        std::string hash;  ///< of the file as it is now; empty when it is missing
    };
    using Findings = std::map<std::string, Finding>;

    void show(const Findings& findings);
    void showFacts();
    void readOtherwise(const ModelReference& as);
    void useAsItIs(const std::string& path, const std::string& hash);
    void replace(const std::string& path, const QString& file);

    Workbench& m_bench;
    std::map<std::string, FileMark> m_marks;
    std::set<std::string> m_told;  ///< paths, once each while the project is open
};

}  // namespace reflet
